// How far a pull takes its surroundings along: the falloffs, on a row of vertices.
"use strict";

(() => {
  const names = [
    ["Classic", "Clásico"],
    ["Smooth", "Suave"],
    ["Sphere", "Esfera"],
    ["Root", "Raíz"],
    ["Linear", "Lineal"],
    ["Sharp", "Agudo"],
    ["Constant", "Constante"],
    ["Gaussian", "Gaussiano"],
  ];

  MotusFigures.add("falloff", {
    height: 300,
    controls: {
      falloff: { label: ["Falloff", "Decaimiento"], choices: names, value: 1 },
      radius: { label: ["Radius", "Radio"], from: 0.2, to: 3, step: 0.02, value: 2, unit: "m" },
      factor: { label: ["Scale Factor", "Factor de escala"], from: -10, to: 10, step: 0.1, value: 2 },
    },
    handles: { pulled: { label: ["The pulled vertex", "El vértice arrastrado"], value: [0, 1.4] } },
    draw(figure, core, { falloff, radius, factor, pulled }) {
      const { number, range } = MotusFigures;
      const panel = figure.panel({ x: [-3.2, 3.2], y: [-0.2, 2], names: [["distance from the root, m", "distancia a la raíz, m"], ""] });
      const moved = (kind, count) => {
        const places = range(-3.2, 3.2, count);
        const forces = core.call("pull_forces", count, places.map(Math.abs), radius, kind, factor);
        return [...places].map((x, i) => [x, forces[i] * pulled[1]]);
      };
      names.forEach((_, kind) => kind !== falloff && panel.line(moved(kind, 161), "pale"));
      for (const side of [-radius, radius]) panel.line([[side, -0.2], [side, 2]], "dashed");
      panel.text([radius, 2], ["radius", "radio"], { anchor: "end", kind: "small", move: [-5, 15] });
      panel.line(moved(falloff, 321), "first");
      panel.dots(moved(falloff, 65), "ink", 2.5);
      panel.handle("pulled", ([, y]) => [0, y]);
      const [half] = core.call("pull_forces", 1, [radius / 2], radius, falloff, factor);
      const share = number(100 * half, 0);
      return [
        `Half a radius away a vertex goes ${share} % of the way${falloff === 0 ? " · Classic reaches as far as the root of its radius" : ""}`,
        `A medio radio un vértice recorre el ${share} % del camino${falloff === 0 ? " · Clásico llega hasta la raíz de su radio" : ""}`,
      ];
    },
  });
})();
