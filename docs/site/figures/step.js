// How an output follows a sudden step of its input: second-order dynamics by frequency, damping and response.
"use strict";

MotusFigures.add("step", {
  height: 300,
  controls: {
    frequency: { label: ["Frequency", "Frecuencia"], from: 0.2, to: 6, step: 0.05, value: 1.5, unit: "Hz" },
    damping: { label: ["Damping", "Amortiguación"], from: 0, to: 2, step: 0.01, value: 0.35 },
    response: { label: ["Response", "Respuesta"], from: -2, to: 3, step: 0.05, value: 0 },
  },
  draw(figure, core, { frequency, damping, response }) {
    const { number, range } = MotusFigures;
    const panel = figure.panel({ x: [-0.25, 3], y: [-0.6, 2.1], names: [["time, s", "tiempo, s"], ""] });
    const times = range(-0.25, 3, 651);
    const values = core.call("step_response", times.length, times, frequency, damping, response);
    const [overshoot, settling] = core.call("step_measures", 2, frequency, damping, response);
    panel.area([-0.25, 0.98], [3, 1.02], "pale-third");
    panel.line([[-0.25, 0], [0, 0], [0, 1], [3, 1]], "dashed");
    if (settling < 3) {
      panel.line([[settling, -0.6], [settling, 1]], "dashed");
      panel.text([settling, -0.6], ["settled", "en reposo"], { kind: "small", move: [5, -8] });
    }
    panel.line([...times].map((time, i) => [time, Math.min(Math.max(values[i], -0.6), 2.1)]), "first");
    panel.text([3, 1], ["input", "entrada"], { anchor: "end", kind: "small", move: [-6, -9] });
    const rest = Number.isFinite(settling)
      ? [`within 2 % after ${number(settling)} s`, `dentro del 2 % tras ${number(settling)} s`]
      : ["it never comes to rest", "nunca llega al reposo"];
    return [
      `It passes its goal by ${number(100 * overshoot, 1)} % · ${rest[0]}`,
      `Rebasa su meta en un ${number(100 * overshoot, 1)} % · ${rest[1]}`,
    ];
  },
});
