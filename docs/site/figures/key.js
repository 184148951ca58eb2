// A colour key on a sample frame: the picture, its matte, and the subject over another ground.
"use strict";

(() => {
  const [wide, high] = [120, 80];

  /** The sample: an orange ball, blond hairs and a grey veil before an uneven green screen. Scene-linear red, green, blue, alpha. */
  function frame() {
    const pixels = new Float64Array(4 * wide * high);
    for (let row = 0; row < high; ++row) {
      for (let column = 0; column < wide; ++column) {
        const [u, v] = [column / wide, row / high];
        const light = 0.8 + 0.25 * u - 0.12 * v;
        let color = [0.06 * light, 0.42 * light, 0.09 * light];
        const over = (other, alpha) => (color = color.map((one, i) => one + (other[i] - one) * alpha));
        const [x, y] = [(u - 0.36) * 1.5, v - 0.56];
        const shade = 0.35 + 0.65 * Math.min(Math.max(0.5 - 1.4 * x - 1.6 * y, 0), 1);
        const hair = Math.abs(x - 0.05 * Math.sin(9 * y) - 0.07 * Math.round((x - 0.05 * Math.sin(9 * y)) / 0.07));
        if (y < 0 && y > -0.44 && Math.abs(x) < 0.24) over([0.62, 0.45, 0.18], Math.min(Math.max(1.2 - hair / 0.009, 0), 0.9));
        over([0.8 * shade, 0.28 * shade, 0.05 * shade], Math.min(Math.max((0.27 - Math.hypot(x, y)) / 0.02, 0), 1));
        over([0.35, 0.36, 0.4], 0.45 * Math.min(Math.max((0.16 - Math.abs(u - 0.8)) / 0.03, 0), 1) * (v > 0.2 ? 1 : 0));
        pixels.set([...color, 1], 4 * (row * wide + column));
      }
    }
    return pixels;
  }

  /** Address of a picture of scene-linear colours: of each pixel the three that `color(i)` says. */
  function address(color) {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [wide, high];
    const context = canvas.getContext("2d");
    const image = context.createImageData(wide, high);
    for (let i = 0; i < wide * high; ++i) {
      image.data.set([...color(i).map((one) => 255 * Math.max(one, 0) ** (1 / 2.2)), 255], 4 * i);
    }
    context.putImageData(image, 0, 0);
    return canvas.toDataURL();
  }

  const pixels = frame();
  const pixel = (i) => pixels.subarray(4 * i, 4 * i + 3);

  MotusFigures.add("key", {
    height: (width) => Math.round(width < 560 ? width + 50 : (width - 40) / 4.5 + 36),
    controls: {
      picked: { label: ["Screen Color", "Color de pantalla"], choices: [["Found", "Hallado"], ["Under the handle", "Bajo el asa"]], value: 0 },
      balance: { label: ["Balance", "Equilibrio"], from: 0, to: 1, step: 0.01, value: 0.5 },
      gain: { label: ["Gain", "Ganancia"], from: 0, to: 3, step: 0.02, value: 1.2 },
    },
    handles: { place: { label: ["Place of the screen's colour", "Lugar del color de la pantalla"], value: [0.9, 0.9] } },
    changed(figure, name) {
      if (name === "place") figure.set({ picked: 1 });
    },
    draw(figure, core, { picked, balance, gain, place }) {
      const { number } = MotusFigures;
      const isNarrow = figure.width < 560;
      const width = isNarrow ? figure.width - 16 : (figure.width - 40) / 3;
      const height = (width * high) / wide;
      const half = (width - 12) / 2;
      const boxes = isNarrow
        ? [[8, 8, width, height], [8, height + 36, half, (half * high) / wide], [20 + half, height + 36, half, (half * high) / wide]]
        : [0, 1, 2].map((i) => [8 + i * (width + 12), 8, width, height]);
      const names = [["frame", "fotograma"], ["matte", "mate"], ["over blue", "sobre azul"]];
      const [shown, matted, laid] = boxes.map((box, i) => figure.panel({ box, x: [0, 1], y: [0, 1], marks: false, names: [names[i], ""] }));
      const show = (panel, color) => panel.image(address(color), [0, 0], [1, 1]);
      show(shown, (i) => [...pixel(i)]);
      shown.handle("place");
      const column = Math.min(Math.floor(place[0] * wide), wide - 1);
      const row = Math.min(Math.floor((1 - place[1]) * high), high - 1);
      const color = picked ? [...pixel(row * wide + column)] : [...core.call("screen_color", 3, pixels, wide)];
      const matte = core.call("screen_matte", wide * high, pixels, color, balance, gain);
      const [, black, white] = core.call("screen_report", 3, pixels, wide, color, balance, gain);
      show(matted, (i) => [matte[i], matte[i], matte[i]]);
      // What is left of a pixel when the screen has been taken out, over a blue ground.
      show(laid, (i) => pixel(i).map((one, axis) => Math.max(one - (1 - matte[i]) * color[axis], 0) + (1 - matte[i]) * [0.05, 0.12, 0.4][axis]));
      const rgb = color.map((one) => number(one)).join(" ");
      return [
        `Screen colour ${rgb} · the matte is clear up to ${number(black)} and opaque from ${number(white)} on`,
        `Color de pantalla ${rgb} · el mate es transparente hasta ${number(black)} y opaco desde ${number(white)}`,
      ];
    },
  });
})();
