// The gait diagram of a walker: which foot stands when.
"use strict";

(() => {
  const gaits = [
    ["Tripod", "Trípode"],
    ["Tetrapod", "Tetrápodo"],
    ["Ripple", "Onda doble"],
    ["Wave", "Onda"],
    ["Trot", "Trote"],
    ["Pace", "Ambladura"],
    ["Walk", "Caminar"],
    ["Run", "Correr"],
    ["Canter", "Galope corto"],
    ["Gallop", "Galope"],
    ["Hop", "A saltos"],
  ];
  const turns = 2;

  MotusFigures.add("gait", {
    height: (width) => (width < 560 ? 420 : 260),
    controls: {
      gait: { label: ["Gait", "Paso"], choices: gaits, value: 6 },
      pairs: { label: ["Pairs of legs", "Pares de patas"], from: 1, to: 5, step: 1, value: 2 },
      cycle: { label: ["Cycle", "Ciclo"], from: 0, to: turns, step: 0.01, value: 0.6, plays: true },
      speed: { label: ["Speed", "Velocidad"], from: 0.1, to: 8, step: 0.1, value: 1.4, unit: "m/s" },
      hip: { label: ["Hip height", "Altura de cadera"], from: 0.1, to: 2, step: 0.05, value: 0.9, unit: "m" },
    },
    draw(figure, core, { gait, pairs, cycle, speed, hip }) {
      const { number, say } = MotusFigures;
      const legs = [];
      for (const [side, x] of [["L", -1], ["R", 1]]) {
        for (let pair = 0; pair < pairs; ++pair) legs.push({ name: `${side}${pair + 1}`, place: [x, pairs - 1 - 2 * pair] });
      }
      const found = core.call("gait_pattern", legs.length + 1, legs.flatMap(({ place }) => [...place, 0]), gait);
      const duty = found[legs.length];
      const swing = 1 - duty;
      const isStanding = (leg) => (cycle + found[leg]) % 1 >= swing;

      const isNarrow = figure.width < 560;
      const body = figure.panel({
        box: isNarrow ? [figure.width / 2 - 90, 8, 180, 150] : [8, 8, 150, figure.height - 52],
        x: [-2, 2],
        y: [-pairs - 0.4, pairs + 0.4],
        marks: false,
      });
      body.line([[-0.35, -pairs], [0.35, -pairs], [0.35, pairs - 0.4], [0, pairs + 0.2], [-0.35, pairs - 0.4]], "thin", true);
      legs.forEach(({ place: [x, y] }, leg) => {
        body.line([[Math.sign(x) * 0.35, y], [x * 1.3, y]], "thin");
        body.dots([[x * 1.3, y]], isStanding(leg) ? "first" : "pale", isStanding(leg) ? 8 : 4);
      });

      const left = isNarrow ? 34 : 206;
      const top = isNarrow ? 174 : 8;
      const diagram = figure.panel({
        box: [left, top, figure.width - left - 12, figure.height - 44 - top],
        x: [0, turns],
        y: [0, legs.length],
        marks: false,
        names: [["cycles; a bar is a foot on the ground", "ciclos; una barra es un pie en el suelo"], ""],
      });
      legs.forEach(({ name }, leg) => {
        const row = legs.length - leg;
        diagram.text([0, row - 0.5], name, { anchor: "end", kind: "small", move: [-7, 4] });
        for (let turn = -1; turn <= turns; ++turn) {
          const from = Math.max(turn + swing - found[leg], 0);
          const to = Math.min(turn + 1 - found[leg], turns);
          if (to > from) diagram.area([from, row - 0.8], [to, row - 0.2], "first");
        }
      });
      diagram.line([[cycle, 0], [cycle, legs.length]], "second");
      const standing = legs.filter((_, leg) => isStanding(leg)).length;
      const [stride] = core.call("natural_stride", 1, speed, hip);
      const lasts = number(stride / speed);
      return [
        `${standing} of ${legs.length} feet stand; each ${number(100 * duty, 0)} % of the time · a natural stride is ${number(stride)} m and takes ${lasts} s`,
        `${standing} de ${legs.length} pies apoyados; cada uno el ${number(100 * duty, 0)} % del tiempo · una zancada natural mide ${number(stride)} m y dura ${lasts} s`,
      ];
    },
  });
})();
