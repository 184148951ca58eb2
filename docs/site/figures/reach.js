// Two bones reach for a target: with a knee that bends between two angles, and, pale, without limits.
"use strict";

MotusFigures.add("reach", {
  height: 360,
  controls: {
    least: { label: ["Least bend", "Flexión mínima"], from: 0, to: 150, step: 1, value: 15, unit: "°" },
    most: { label: ["Most bend", "Flexión máxima"], from: 0, to: 150, step: 1, value: 95, unit: "°" },
    lower: { label: ["Lower bone", "Hueso inferior"], from: 0.4, to: 1.4, step: 0.02, value: 1, unit: "m" },
    softness: { label: ["Softness", "Suavidad"], from: 0, to: 0.6, step: 0.01, value: 0.1, unit: "m" },
  },
  handles: { target: { label: ["Target", "Objetivo"], value: [0.75, 0.7] } },
  changed(figure, name) {
    const { least, most } = figure.values;
    if (name === "least") figure.set({ most: Math.max(least, most) });
    if (name === "most") figure.set({ least: Math.min(least, most) });
  },
  draw(figure, core, { least, most, lower, softness, target }) {
    const { number, range, rows } = MotusFigures;
    const panel = figure.panel({ box: [8, 8, figure.width - 16, figure.height - 16], x: [-2.6, 2.6], y: [-2.1, 2.1], equal: true, marks: false });
    const goal = [...target, 0];
    const circle = (radius) => [...range(0, 2 * Math.PI, 97)].map((turn) => [radius * Math.cos(turn), radius * Math.sin(turn)]);
    const radians = (degrees) => (degrees * Math.PI) / 180;

    // The farthest and the nearest place that the knee's limits let the tip come to: the tip of a chain that is bent so.
    const straight = [0, 0, 0, 1, 0, 0, 1 + lower, 0, 0];
    const solved = (first, last, to) => {
      const limits = [0, 0, -Infinity, 0, 0, Infinity, 0, 0, radians(first), 0, 0, radians(last)];
      return core.call("limited_chain", 11, straight, to, limits);
    };
    for (const bend of [least, most]) {
      const chain = solved(bend, bend, goal);
      panel.line(circle(Math.hypot(chain[6], chain[7])), "dashed");
    }
    const free = rows(core.call("two_bone", 9, goal, [1, -9, 0], 1, lower, softness, 0).slice(0, 6), 3);
    panel.line([[0, 0], ...free], "ghost");
    const found = solved(least, most, goal);
    const joints = rows(found.slice(0, 9), 3);
    panel.line(joints, "bone");
    panel.dots(joints.slice(0, 2), "ink", 5);
    panel.line([joints[2], target], "second");
    panel.handle("target");
    const missed = found[9] > 1e-4;
    return missed
      ? [`The tip stays ${number(found[9])} m short: the knee bends from ${least}° to ${most}°`,
         `La punta se queda a ${number(found[9])} m: la rodilla se flexiona de ${least}° a ${most}°`]
      : ["The tip is on its target · pale: without limits, with softness", "La punta está en su objetivo · pálido: sin límites, con suavidad"];
  },
});
