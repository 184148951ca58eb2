// What the manual's figures share. In a page, every <div class="motus-figure" data-figure="NAME"> holds a still picture; where the browser knows
// WebAssembly the figure of NAME.js takes its place. All mathematics is the C++ core's (motus.wasm, native/web); the files beside this one draw it.
"use strict";

const MotusFigures = (() => {
  const folder = document.currentScript.src.replace(/[^/]*$/, "");
  const language = document.documentElement.lang.startsWith("es") ? "es" : "en";
  const definitions = {};
  const figures = [];
  let packed = null;

  /** A text in the page's language: of ["English", "Spanish"], or one for both. */
  const say = (text) => (Array.isArray(text) ? text[language === "es" ? 1 : 0] : text);

  /** A number as the page's language writes it. */
  const number = (value, digits = 2) => {
    if (!Number.isFinite(value)) return value > 0 ? "∞" : value < 0 ? "−∞" : "?";
    return value.toLocaleString(language, { maximumFractionDigits: digits }).replace("-", "−");
  };

  /** Numbers from `from` to `to`, both included. */
  const range = (from, to, count) => Float64Array.from({ length: count }, (_, i) => from + ((to - from) * i) / (count - 1));

  /** Rows of `size` numbers. */
  const rows = (numbers, size) => Array.from({ length: numbers.length / size }, (_, i) => numbers.slice(i * size, (i + 1) * size));

  const svg = (tag, attributes, parent) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    if (parent) parent.append(element);
    return element;
  };

  const html = (tag, properties, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };

  /** The C++ functions. An argument that they refuse is an Error with their sentence. */
  class Core {
    constructor(exports) {
      this.exports = exports;
    }

    static async load() {
      let exports = null;
      const refuse = (text) => {
        const rest = new Uint8Array(exports.memory.buffer, text);
        throw new Error(new TextDecoder().decode(rest.slice(0, rest.indexOf(0))));
      };
      // What the C library would write a last word to before it ends the module.
      const nowhere = () => 8;
      const wasi_snapshot_preview1 = { fd_close: nowhere, fd_seek: nowhere, fd_write: nowhere };
      const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
      const bytes = await new Response(unpacked).arrayBuffer();
      exports = (await WebAssembly.instantiate(bytes, { motus: { refuse }, wasi_snapshot_preview1 })).instance.exports;
      exports._initialize();
      return new Core(exports);
    }

    /** Calls a function of native/web by numbers and arrays of numbers; returns the `count` numbers that it writes. */
    call(name, count, ...given) {
      const { memory, room, __stack_pointer: stack } = this.exports;
      const total = given.reduce((sum, one) => sum + (typeof one === "number" ? 0 : one.length), count);
      const start = room(total);
      const top = stack.value;
      const numbers = new Float64Array(memory.buffer, start, total);
      const passed = [];
      let used = 0;
      for (const one of given) {
        if (typeof one === "number") {
          passed.push(one);
        } else {
          numbers.set(one, used);
          passed.push(start + 8 * used, one.length);
          used += one.length;
        }
      }
      try {
        this.exports[name](...passed, start + 8 * used);
      } finally {
        stack.value = top;
      }
      return new Float64Array(memory.buffer, start + 8 * used, count).slice();
    }
  }

  /** A part of the picture with coordinates of its own: x and y from [least, most], y upwards, in a box [left, top, width, height] of pixels. */
  class Panel {
    constructor(figure, { box, x, y, names = [], equal = false, marks = true, hidden = false }) {
      const wide = figure.width;
      this.figure = figure;
      const [left, top, width, height] = box ?? [46, 12, wide - 58, figure.height - 54];
      this.box = { left, top, width, height };
      this.x = [...x];
      this.y = [...y];
      if (equal) this.widen();
      if (!hidden) this.frame(names.map(say), marks);
    }

    /** Makes a unit as long in x as in y. */
    widen() {
      const { width, height } = this.box;
      const unit = Math.max((this.x[1] - this.x[0]) / width, (this.y[1] - this.y[0]) / height);
      for (const [ends, size] of [[this.x, width], [this.y, height]]) {
        const spare = (unit * size - (ends[1] - ends[0])) / 2;
        ends[0] -= spare;
        ends[1] += spare;
      }
    }

    right = (x) => this.box.left + ((x - this.x[0]) / (this.x[1] - this.x[0])) * this.box.width;
    down = (y) => this.box.top + ((this.y[1] - y) / (this.y[1] - this.y[0])) * this.box.height;
    place = ([x, y]) => [this.right(x), this.down(y)];

    /** The coordinates of a place in the picture, within the panel. */
    inverse(right, down) {
      const { left, top, width, height } = this.box;
      const share = (value) => Math.min(Math.max(value, 0), 1);
      return [
        this.x[0] + share((right - left) / width) * (this.x[1] - this.x[0]),
        this.y[1] - share((down - top) / height) * (this.y[1] - this.y[0]),
      ];
    }

    frame([xName, yName], marks) {
      const { left, top, width, height } = this.box;
      svg("rect", { x: left, y: top, width, height, class: "field" }, this.figure.drawing);
      if (marks) {
        for (const x of steps(this.x, width / 70)) {
          this.line([[x, this.y[0]], [x, this.y[1]]], "grid");
          this.pixels(this.right(x), top + height + 16, number(x, 3), "middle", "small");
        }
        for (const y of steps(this.y, height / 40)) {
          this.line([[this.x[0], y], [this.x[1], y]], "grid");
          this.pixels(left - 6, this.down(y) + 4, number(y, 3), "end", "small");
        }
      }
      if (xName) this.pixels(left + width / 2, top + height + (marks ? 33 : 17), xName, "middle", "small");
      if (yName) this.pixels(left + 4, top + 14, yName, "start", "small");
    }

    /** A text at a place in the picture; returns its element. */
    pixels(right, down, text, anchor = "start", kind = "") {
      const element = svg("text", { x: right, y: down, "text-anchor": anchor, class: kind }, this.figure.drawing);
      element.textContent = text;
      return element;
    }

    text([x, y], text, { anchor = "start", kind = "", move = [0, 0] } = {}) {
      return this.pixels(this.right(x) + move[0], this.down(y) + move[1], say(text), anchor, kind);
    }

    line(points, kind, closed = false) {
      const path = [...points].map((point) => this.place(point).map((one) => one.toFixed(1)).join(" ")).join("L");
      return svg("path", { d: `M${path}${closed ? "Z" : ""}`, class: kind }, this.figure.drawing);
    }

    dots(points, kind, radius = 3.5) {
      for (const point of points) {
        const [cx, cy] = this.place(point).map((one) => one.toFixed(1));
        svg("circle", { cx, cy, r: radius, class: kind }, this.figure.drawing);
      }
    }

    /** A rectangle between two corners. */
    area([x0, y0], [x1, y1], kind) {
      const [left, right] = [this.right(x0), this.right(x1)];
      const [top, bottom] = [this.down(y1), this.down(y0)];
      return svg("rect", { x: left, y: top, width: Math.max(right - left, 0), height: Math.max(bottom - top, 0), class: kind }, this.figure.drawing);
    }

    image(address, [x0, y0], [x1, y1]) {
      const [[x, bottom], [right, y]] = [this.place([x0, y0]), this.place([x1, y1])];
      const given = { href: address, x, y, width: right - x, height: bottom - y, preserveAspectRatio: "none" };
      return svg("image", given, this.figure.drawing);
    }

    /**
     * The handle of a value [x, y], which is dragged, or moved by the keys with arrows. `bound` brings a new value into its domain; `at` is where
     * the handle stands if that is not the value.
     */
    handle(name, bound = (value) => value, at = this.figure.values[name]) {
      this.figure.handleOf(name).put(this, bound, at);
    }
  }

  /** Round numbers within a range, about `wanted` of them. */
  function steps([least, most], wanted) {
    const rough = (most - least) / Math.max(wanted, 2);
    const ten = 10 ** Math.floor(Math.log10(rough));
    const step = ten * [1, 2, 5, 10].find((one) => one * ten >= rough);
    const found = [];
    for (let i = Math.ceil(least / step - 1e-9); i * step <= most + 1e-9 * step; ++i) found.push(i * step + 0); // no -0
    return found;
  }

  /** What a value [x, y] is dragged by. */
  class Handle {
    constructor(figure, name, label) {
      this.figure = figure;
      this.name = name;
      const given = { class: "handle", tabindex: 0, role: "slider", "aria-label": say(label), "data-value": name };
      this.element = svg("g", given, figure.handles);
      svg("circle", { r: 20, class: "reach" }, this.element);
      svg("circle", { r: 8, class: "grip" }, this.element);
      svg("title", {}, this.element).textContent = say(label);
      this.element.addEventListener("pointerdown", (event) => {
        this.element.setPointerCapture(event.pointerId);
        this.element.focus();
        event.preventDefault();
      });
      this.element.addEventListener("pointermove", (event) => {
        if (!this.element.hasPointerCapture(event.pointerId)) return;
        const box = figure.picture.getBoundingClientRect();
        this.set(this.panel.inverse(event.clientX - box.left, event.clientY - box.top));
      });
      this.element.addEventListener("keydown", (event) => {
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        if (!way) return;
        const size = event.shiftKey ? 40 : 8;
        const [right, down] = this.panel.place(this.at);
        this.set(this.panel.inverse(right + way[0] * size, down + way[1] * size));
        event.preventDefault();
      });
    }

    set(value) {
      this.figure.change(this.name, this.bound(value));
    }

    put(panel, bound, at) {
      Object.assign(this, { panel, bound, at });
      this.element.setAttribute("transform", `translate(${panel.place(at).map((one) => one.toFixed(1))})`);
      this.element.setAttribute("aria-valuenow", at[0]);
      this.element.setAttribute("aria-valuetext", at.map((one) => number(one)).join("; "));
      this.element.style.display = "";
    }
  }

  /** One figure in a page, in place of the still picture in its element. */
  class Figure {
    constructor(element, definition, core) {
      this.element = element;
      this.definition = definition;
      this.core = core;
      this.values = {};
      this.inputs = {};
      this.held = {};
      const label = element.querySelector("img")?.alt ?? "";
      this.picture = svg("svg", { role: "group", "aria-label": label, width: "100%" });
      this.drawing = svg("g", {}, this.picture);
      this.handles = svg("g", {}, this.picture);
      this.told = html("output", { className: "told" });
      this.controls = html("div", { className: "controls" });
      for (const [name, control] of Object.entries(definition.controls ?? {})) this.controls.append(this.control(name, control));
      const reset = html("button", { type: "button", onclick: () => this.reset() }, say(["Reset", "Restablecer"]));
      element.replaceChildren(this.picture, html("div", { className: "said" }, this.told, reset), this.controls);
      element.classList.add("moves");
      this.reset();
      new ResizeObserver(() => this.draw()).observe(this.picture);
    }

    /** The row of a slider, or of a choice between names. */
    control(name, { label, choices, from, to, step, unit = "", digits = 2, plays = false }) {
      const shown = html("span", { className: "shown" });
      const change = (event) => this.change(name, Number(event.target.value));
      let input = null;
      if (choices) {
        input = html("select", { onchange: change }, ...choices.map((one, i) => html("option", { value: i }, say(one))));
      } else {
        input = html("input", { type: "range", min: from, max: to, step, oninput: change });
      }
      this.inputs[name] = (value) => {
        input.value = value;
        if (choices) return;
        shown.textContent = `${number(value, digits)}${unit && ` ${unit}`}`;
        input.setAttribute("aria-valuetext", shown.textContent);
      };
      const parts = choices ? [input] : [input, shown];
      const row = html("div", { className: "row" }, html("label", {}, html("span", {}, say(label)), ...parts));
      if (plays) row.append(this.player(name, from, to));
      return row;
    }

    /** A button that lets a slider run, one unit a second, from its start again when it is at its end. */
    player(name, from, to) {
      let last = null;
      const button = html("button", { type: "button" });
      const show = () => {
        button.textContent = last === null ? "▶" : "❚❚";
        button.ariaLabel = button.title = say(last === null ? ["Play", "Reproducir"] : ["Pause", "Pausa"]);
      };
      const tick = (now) => {
        if (last === null || !this.element.isConnected) return;
        const next = this.values[name] + Math.max(now - last, 0) / 1000;
        last = now;
        this.change(name, next > to ? from : next);
        requestAnimationFrame(tick);
      };
      button.onclick = () => {
        last = last === null ? performance.now() : null;
        show();
        if (last !== null) requestAnimationFrame(tick);
      };
      show();
      return button;
    }

    handleOf(name) {
      this.held[name] ??= new Handle(this, name, this.definition.handles[name].label);
      return this.held[name];
    }

    reset() {
      const all = { ...this.definition.controls, ...this.definition.handles };
      for (const [name, { value }] of Object.entries(all)) {
        this.values[name] = Array.isArray(value) ? [...value] : value;
        this.inputs[name]?.(value);
      }
      this.draw();
    }

    change(name, value) {
      const before = { ...this.values };
      this.set({ [name]: value });
      this.definition.changed?.(this, name, before);
      this.draw();
    }

    /** Sets values, and shows them in their sliders. */
    set(values) {
      for (const [name, value] of Object.entries(values)) {
        this.values[name] = value;
        this.inputs[name]?.(value);
      }
    }

    draw() {
      this.width = Math.max(Math.round(this.picture.getBoundingClientRect().width), 240); // none while it is hidden
      this.height = typeof this.definition.height === "function" ? this.definition.height(this.width) : this.definition.height;
      this.picture.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
      this.picture.setAttribute("height", this.height);
      this.drawing.replaceChildren();
      for (const handle of Object.values(this.held)) handle.element.style.display = "none";
      try {
        this.told.textContent = say(this.definition.draw(this, this.core, this.values)) ?? "";
      } catch (problem) {
        this.told.textContent = problem.message;
      }
    }

    panel(settings) {
      return new Panel(this, settings);
    }
  }

  /** Loads a file that stands beside this one, as what such an element names by `key`. */
  const load = (tag, key, name, more = {}) =>
    new Promise((done, failed) => {
      document.head.append(html(tag, { [key]: `${folder}${name}`, onload: done, onerror: failed, ...more }));
    });

  /** Brings the page's figures to life. */
  async function start() {
    const found = [...document.querySelectorAll(".motus-figure[data-figure]:not(.moves)")];
    if (!found.length || typeof WebAssembly === "undefined") return;
    const names = ["motus", ...new Set(found.map((one) => one.dataset.figure))];
    const style = load("link", "href", "figures.css", { rel: "stylesheet" });
    await Promise.all([style, ...names.map((name) => load("script", "src", `${name}.js`))]);
    const core = await Core.load();
    for (const element of found) figures.push(new Figure(element, definitions[element.dataset.figure], core));
    document.documentElement.dataset.motusFigures = figures.length;
  }

  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
  else start();

  return {
    say,
    number,
    range,
    rows,
    figures,
    add: (name, definition) => (definitions[name] = definition),
    module: (text) => (packed = Uint8Array.from(atob(text), (one) => one.charCodeAt(0))),
  };
})();
