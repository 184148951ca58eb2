// A ride along a Bézier curve: equal distances, ease, and the bank of a follower. Seen from above; heights are drawn upwards.
"use strict";

(() => {
  const lasts = 2.5;

  MotusFigures.add("bezier", {
    height: 440,
    controls: {
      time: { label: ["Time", "Tiempo"], from: 0, to: lasts, step: 0.01, value: 0.9, unit: "s", plays: true },
      easeIn: { label: ["Ease In", "Entrada suave"], from: 0, to: 0.5, step: 0.01, value: 0.3 },
      easeOut: { label: ["Ease Out", "Salida suave"], from: 0, to: 0.5, step: 0.01, value: 0.3 },
      bank: { label: ["Bank", "Peralte"], from: -1, to: 2, step: 0.05, value: 1 },
    },
    handles: {
      start: { label: ["Start of the curve", "Inicio de la curva"], value: [-5, -1.2] },
      startHandle: { label: ["Handle of the start", "Asa del inicio"], value: [-3.6, 2.3] },
      endHandle: { label: ["Handle of the end", "Asa del final"], value: [1.2, -2.4] },
      end: { label: ["End of the curve", "Final de la curva"], value: [5, 1.3] },
    },
    draw(figure, core, { time, easeIn, easeOut, bank, start, startHandle, endHandle, end }) {
      const { number, range, rows } = MotusFigures;
      const wide = figure.width;
      const points = [start, startHandle, endHandle, end].flatMap(([x, y]) => [x, y, 0]);
      const above = figure.panel({ box: [8, 8, wide - 16, 270], x: [-6.4, 6.4], y: [-2.6, 2.6], equal: true, marks: false });
      above.line([start, startHandle], "dashed");
      above.line([end, endHandle], "dashed");
      const places = rows(core.call("bezier_places", 3 * 201, points, range(0, 1, 201)), 3);
      above.line(places, "first");
      const rideAt = (times) => rows(core.call("bezier_ride", 11 * times.length, points, times, lasts, easeIn, easeOut, bank), 11);
      const seen = (ride, right, up) => [
        ride[0] + right * ride[3] + up * ride[6],
        ride[1] + right * ride[4] + up * ride[7] + right * ride[5] + up * ride[8],
      ];
      for (const ride of rideAt(range(0, lasts, 25))) {
        above.dots([ride], "ink", 3);
        above.line([seen(ride, -0.55, 0), seen(ride, 0.55, 0)], "faint");
      }
      const [now] = rideAt([time]);
      above.line([seen(now, -1.1, 0), seen(now, 1.1, 0)], "second");
      above.line([now, seen(now, 0, 0.6)], "second");
      above.dots([now], "second", 6);
      for (const name of ["startHandle", "endHandle", "start", "end"]) above.handle(name);

      const [length] = core.call("bezier_length", 1, points);
      const below = figure.panel({
        box: [46, 296, wide - 58, 92],
        x: [0, lasts],
        y: [0, Math.ceil(length / 5) * 5],
        names: [["time, s", "tiempo, s"], ["distance, m", "distancia, m"]],
      });
      const times = range(0, lasts, 161);
      below.line(rideAt(times).map((ride, i) => [times[i], ride[9]]), "first");
      below.dots([[time, now[9]]], "second", 6);
      const roll = (-Math.asin(Math.min(Math.max(now[5], -1), 1)) * 180) / Math.PI;
      const told = `${number(now[9])} m, ${number(now[10])} m/s`;
      const side = roll < 0 ? ["to the left", "a la izquierda"] : ["to the right", "a la derecha"];
      return [
        `${number(length)} m long · after ${number(time)} s: ${told}, banked ${number(Math.abs(roll), 0)}° ${side[0]}`,
        `${number(length)} m de largo · tras ${number(time)} s: ${told}, peralte de ${number(Math.abs(roll), 0)}° ${side[1]}`,
      ];
    },
  });
})();
