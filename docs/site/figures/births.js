// When flakes are born while the rate is keyed: as many as the area under the rate has grown to.
"use strict";

(() => {
  const keys = ["first", "second", "third", "fourth"];
  const label = (i) => [`Key ${i + 1} of the rate`, `Clave ${i + 1} de la tasa`];
  const places = [[0.4, 1], [2, 14], [3.4, 3], [5.2, 9]];
  const end = 6;
  const most = 20;

  MotusFigures.add("births", {
    height: 400,
    controls: { time: { label: ["Time", "Tiempo"], from: 0, to: end, step: 0.01, value: 3, unit: "s", plays: true } },
    handles: Object.fromEntries(keys.map((key, i) => [key, { label: label(i), value: places[i] }])),
    draw(figure, core, values) {
      const { number, range } = MotusFigures;
      const { time } = values;
      const width = figure.width - 58;
      const given = keys.map((key) => values[key]);
      const times = given.map(([at]) => at);
      const rates = given.map(([, rate]) => rate);
      const held = [[0, rates[0]], ...given, [end, rates[3]]];
      const count = (moments) => core.call("birth_counts", moments.length, times, rates, moments);

      const rate = figure.panel({ box: [46, 10, width, 150], x: [0, end], y: [0, most], names: ["", ["flakes a second", "copos por segundo"]] });
      const before = held.filter(([at]) => at < time);
      const after = held[before.length] ?? held[held.length - 1];
      const last = before[before.length - 1] ?? held[0];
      const share = after[0] > last[0] ? (time - last[0]) / (after[0] - last[0]) : 0;
      rate.line([[0, 0], ...before, [time, last[1] + share * (after[1] - last[1])], [time, 0]], "fill-first", true);
      rate.line(held, "first");
      keys.forEach((key, i) => {
        const least = i === 0 ? 0 : times[i - 1] + 0.05;
        const largest = i === keys.length - 1 ? end : times[i + 1] - 0.05;
        rate.handle(key, ([at, value]) => [Math.min(Math.max(at, least), largest), value]);
      });

      const moments = range(0, end, 601);
      const counts = count(moments);
      const total = counts[counts.length - 1];
      const flakes = figure.panel({
        box: [46, 196, width, 150],
        x: [0, end],
        y: [0, Math.max(10 * Math.ceil(total / 10), 10)],
        names: [["time, s", "tiempo, s"], ["flakes born", "copos nacidos"]],
      });
      flakes.line([...moments].map((moment, i) => [moment, counts[i]]), "first");
      const born = core.call("birth_times", total, times, rates, total);
      flakes.dots([...born].map((moment, i) => [moment, i + 1]), "ink", 1.8);
      for (const panel of [rate, flakes]) panel.line([[time, panel.y[0]], [time, panel.y[1]]], "second");
      const [now] = count([time]);
      const next = born[now];
      const wait = [`, the next one at ${number(next)} s`, `; el siguiente, a los ${number(next)} s`];
      return [
        `Until ${number(time)} s ${number(now)} flakes are born: the whole ones in the shaded area${next === undefined ? "" : wait[0]}`,
        `Hasta los ${number(time)} s han nacido ${number(now)} copos: los enteros del área sombreada${next === undefined ? "" : wait[1]}`,
      ];
    },
  });
})();
