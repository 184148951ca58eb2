// The budget of depth of a stereo camera: the nearest and the farthest thing take all the parallax that is comfortable on a screen.
"use strict";

MotusFigures.add("budget", {
  height: 410,
  controls: {
    width: { label: ["Screen Width", "Ancho de pantalla"], from: 0.3, to: 20, step: 0.1, value: 12, unit: "m" },
    distance: { label: ["Viewer", "Espectador"], from: 0.4, to: 30, step: 0.1, value: 15, unit: "m" },
    share: { label: ["Budget used", "Presupuesto usado"], from: 10, to: 150, step: 1, value: 80, unit: "%" },
    focal: { label: ["Focal Length", "Distancia focal"], from: 18, to: 120, step: 1, value: 50, unit: "mm" },
  },
  handles: {
    near: { label: ["Nearest", "Más cercano"], value: [3, 0] },
    far: { label: ["Farthest", "Más lejos"], value: [14, 0] },
  },
  draw(figure, core, { width, distance, share, focal, near, far }) {
    const { number, range, rows } = MotusFigures;
    const wide = figure.width;
    const [front, behind, apart] = core.call("comfortable_parallax", 3, width, distance);
    const used = share / 100;
    const [interaxial, convergence] = core.call("fit_budget", 2, near[0], far[0], front * used, behind * used, focal);
    const seen = (depths) => rows(core.call("seen_depths", 4 * depths.length, depths, interaxial, convergence, focal, width, distance), 4);

    const top = 100 * Math.max(1.6 * behind, 1.2 * apart, 1.6 * behind * used);
    const bottom = -100 * Math.max(1.6 * front, 1.6 * front * used);
    const scene = figure.panel({
      box: [46, 10, wide - 58, 212],
      x: [0, 20],
      y: [bottom, top],
      names: [["depth in the scene, m", "profundidad en la escena, m"], ["parallax, % of the width", "paralaje, % del ancho"]],
    });
    scene.area([0, -100 * front], [20, 100 * behind], "pale-third");
    scene.area([0, 100 * apart], [20, top], "pale-wrong");
    scene.line([[0, 0], [20, 0]], "dashed");
    scene.text([20, 0], ["the screen", "la pantalla"], { anchor: "end", kind: "small", move: [-6, -6] });
    scene.text([20, 100 * apart], ["eyes turn apart", "los ojos divergen"], { anchor: "end", kind: "small", move: [-6, -6] });
    const depths = range(0.2, 20, 397);
    const line = seen(depths).map(([parallax], i) => [depths[i], 100 * parallax]);
    scene.line(line.filter(([, y]) => y >= bottom && y <= top), "thin");
    const ends = seen([near[0], far[0]]);
    scene.line(line.filter(([x]) => x >= near[0] && x <= far[0]), "first");
    scene.handle("near", ([x]) => [Math.min(Math.max(x, 0.5), far[0] - 0.5), 0], [near[0], 100 * ends[0][0]]);
    scene.handle("far", ([x]) => [Math.max(x, near[0] + 0.5), 0], [far[0], 100 * ends[1][0]]);

    const hall = figure.panel({
      box: [46, 280, wide - 58, 78],
      x: [0, 3 * distance],
      y: [-1, 1.9],
      names: [["where the viewer sees it, m", "donde lo ve el espectador, m"], ""],
      marks: false,
    });
    const at = (row) => Math.min(row[1], 3 * distance);
    hall.area([at(ends[0]), -0.55], [at(ends[1]), 0.55], ends.some((row) => row[3] === 2) ? "pale-wrong" : "pale-third");
    hall.line([[distance, -0.9], [distance, 1.8]], "first");
    const where = number(distance);
    hall.text([distance, 1.9], [`the screen, at ${where} m`, `la pantalla, a ${where} m`], { kind: "small", move: [6, 15] });
    hall.text([0, 1.9], ["the viewer", "el espectador"], { kind: "small", move: [4, 15] });
    hall.dots([[0, 0]], "ink", 6);
    seen(range(near[0], far[0], 9)).forEach((row) => row[1] < 3 * distance && hall.dots([[row[1], 0]], row[3] ? "wrong" : "third", 4));

    const round = seen([convergence])[0][2];
    const strain = Math.max(ends[0][3], ends[1][3]);
    const judged = [["comfortable", "cómodo"], ["straining", "fatiga la vista"], ["eyes turn apart", "los ojos divergen"]][strain];
    const eyes = `${number(1000 * interaxial, 1)} mm`;
    return [
      `Interaxial ${eyes}, convergence ${number(convergence)} m · roundness on the screen ${number(100 * round, 0)} % · ${judged[0]}`,
      `Interaxial ${eyes}, convergencia ${number(convergence)} m · redondez en la pantalla ${number(100 * round, 0)} % · ${judged[1]}`,
    ];
  },
});
