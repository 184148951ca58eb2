// A double pendulum from any start, at any time; and a second one that starts a thousandth of a degree aside.
"use strict";

(() => {
  const angle = ([x, y]) => Math.atan2(x, -y);
  const hung = (theta1, theta2, length) => {
    const first = [Math.sin(theta1), -Math.cos(theta1)];
    return [first, [first[0] + length * Math.sin(theta2), first[1] - length * Math.cos(theta2)]];
  };
  const aside = Math.PI / 180000;

  MotusFigures.add("pendulum", {
    height: 380,
    controls: {
      time: { label: ["Time", "Tiempo"], from: 0, to: 60, step: 0.01, value: 8, unit: "s", plays: true },
      mass: { label: ["Lower mass", "Masa inferior"], from: 0.1, to: 3, step: 0.05, value: 1, unit: "kg" },
      length: { label: ["Lower rod", "Varilla inferior"], from: 0.4, to: 1.4, step: 0.02, value: 1, unit: "m" },
    },
    handles: {
      upper: { label: ["Start of the upper bob", "Inicio de la masa superior"], value: [0.94, 0.34] },
      lower: { label: ["Start of the lower bob", "Inicio de la masa inferior"], value: [1.58, 1.11] },
    },
    /** The lower rod keeps its angle when the upper bob is dragged. */
    changed(figure, name, before) {
      const { upper, lower, length } = figure.values;
      const hanging = angle([lower[0] - before.upper[0], lower[1] - before.upper[1]]);
      const places = hung(angle(upper), hanging, length);
      figure.set({ upper: places[0], lower: places[1] });
      if (name === "upper" || name === "lower") figure.set({ time: 0 });
    },
    draw(figure, core, values) {
      const { number, range, rows } = MotusFigures;
      const { time, mass, length, upper, lower } = values;
      const start = [angle(upper), angle([lower[0] - upper[0], lower[1] - upper[1]])];
      const far = length + 1.15;
      const panel = figure.panel({ box: [8, 8, figure.width - 16, figure.height - 16], x: [-far, far], y: [-far, far], equal: true, marks: false });
      const states = (times, first) => rows(core.call("double_pendulum", 4 * times.length, times, first, start[1], mass, length), 4);
      const drawn = ([theta1, theta2]) => hung(theta1, theta2, length);

      const trail = states(range(Math.max(time - 2.5, 0), time, 200), start[0]).map((state) => drawn(state)[1]);
      panel.line(trail, "faint");
      const [twin] = states([time], start[0] + aside);
      panel.line([[0, 0], ...drawn(twin)], "ghost");
      panel.line([[0, 0], upper, lower], "dashed");
      const [now] = states([time], start[0]);
      const bobs = drawn(now);
      panel.line([[0, 0], ...bobs], "first");
      panel.dots([[0, 0]], "ink", 4);
      panel.dots([bobs[0]], "first", 9);
      panel.dots([bobs[1]], "second", 9 * Math.cbrt(mass));
      panel.handle("upper");
      panel.handle("lower");
      const degrees = (radians) => number((radians * 180) / Math.PI, 1);
      return [
        `After ${number(time)} s: ${degrees(now[0])}° and ${degrees(now[1])}° · grey: started 0.001° aside`,
        `Tras ${number(time)} s: ${degrees(now[0])}° y ${degrees(now[1])}° · gris: parte 0,001° al lado`,
      ];
    },
  });
})();
