// A graph of single readings with curves and bands: drawn as SVG, pointed at by mouse, finger or keys.
// Directions differ by shape, line and colour; the look stands in the style sheet.

import { fill, h, s } from "./dom.js";
import { extent, scale, ticks } from "./scale.js";

const MARGIN = { left: 50, right: 14, top: 8, bottom: 34 };
const REACH = 26;
const MOST_RINGS = 600;
const WIDTH_OF_TICK = 84;
const HEIGHT_OF_TICK = 38;
const MANY = 2000;
const SHORTEST_DRAG = 6;
let count = 0;

export class Plot {
  /** `marked` is told which reading is pointed at (or null), `pinned` which is chosen, `zoomed` the range. */
  constructor({ label, hint, number, marked, pinned, zoomed }) {
    this.number = number;
    this.told = { marked, pinned, zoomed };
    this.identifier = `plot-${(count += 1)}`;
    this.svg = s("svg", { "aria-hidden": "true", focusable: "false" });
    this.text = h("p", { class: "unseen", id: `${this.identifier}-text` });
    this.element = h("div", {
      class: "plot", tabindex: "0", role: "application", "aria-label": label,
      "aria-describedby": `${this.identifier}-text ${hint}`,
      pointermove: (event) => this.#moved(event), pointerleave: () => this.#left(),
      pointerdown: (event) => this.#pressed(event), pointerup: (event) => this.#released(event),
      dblclick: () => zoomed(null), keydown: (event) => this.#typed(event),
    }, this.svg, this.text);
    this.rings = [];
    this.at = null;
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  /** Show readings (`x`, `y`, `direction`, `fitted` arrays), curves, bands, and the level of the noise. */
  show(data) {
    this.data = data;
    this.text.textContent = data.alternative;
    this.#draw();
  }

  /** Ring readings, by their indices; the first of them has a line down to its axis if `crossed`. */
  ring(indices, crossed) {
    this.rings = indices;
    this.crossed = crossed;
    this.#drawRings();
  }

  #draw() {
    const width = this.element.clientWidth;
    const height = this.element.clientHeight;
    if (!this.data || width < 80 || height < 60) return;
    const { data } = this;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const all = [data.y, ...data.curves.flatMap((each) => [each.y, each.low ?? [], each.high ?? []])].flat();
    const [low, high] = extent(data.noise ? [...all, data.noise, -data.noise] : all, 0.06);
    const [first, last] = data.range ?? extent(data.x, data.labels ? 0.35 : 0.015);
    this.x = scale(first, last, MARGIN.left, width - MARGIN.right);
    this.y = scale(low, high, height - MARGIN.bottom, MARGIN.top);
    const inside = { x: MARGIN.left, y: MARGIN.top, width: width - MARGIN.left - MARGIN.right, height: height - MARGIN.top - MARGIN.bottom };
    this.ringed = s("g", { class: "rings" });
    this.selection = s("rect", { class: "selection", y: MARGIN.top, height: inside.height, x: 0, width: 0 });
    fill(this.svg,
      s("clipPath", { id: this.identifier }, s("rect", inside)),
      this.#axes(inside, width, height),
      s("g", { "clip-path": `url(#${this.identifier})` }, this.#levels(inside), this.#curves(), this.#points(), this.selection, this.ringed),
    );
    this.#drawRings();
  }

  #axes(inside, width, height) {
    const { data, x, y } = this;
    const bottom = inside.y + inside.height;
    const across = data.labels
      ? [...data.labels].map(([value, label]) => [value, label])
      : ticks(x.low, x.high, inside.width / WIDTH_OF_TICK).map((value) => [value, this.number(value)]);
    return s("g", { class: "axes" },
      s("rect", { class: "frame", ...inside }),
      ticks(y.low, y.high, inside.height / HEIGHT_OF_TICK).map((value) => [
        s("line", { class: value === 0 ? "zero" : "grid", x1: inside.x, x2: inside.x + inside.width, y1: y(value), y2: y(value) }),
        s("text", { class: "tick", x: inside.x - 7, y: y(value) + 4, "text-anchor": "end" }, this.number(value)),
      ]),
      across.map(([value, label]) => [
        s("line", { class: "grid", x1: x(value), x2: x(value), y1: inside.y, y2: bottom }),
        s("text", { class: "tick", x: x(value), y: bottom + 15, "text-anchor": "middle" }, label),
      ]),
      s("text", { class: "title", x: inside.x + inside.width, y: height - 4, "text-anchor": "end" }, data.xTitle),
      s("text", { class: "title", x: 4, y: height - 4 }, data.yTitle),
    );
  }

  #levels(inside) {
    const { noise } = this.data;
    if (!noise) return [];
    const top = this.y(noise);
    const bottom = this.y(-noise);
    return [
      s("rect", { class: "noise", x: inside.x, width: inside.width, y: top, height: bottom - top }),
      [top, bottom].map((at) => s("line", { class: "noise-edge", x1: inside.x, x2: inside.x + inside.width, y1: at, y2: at })),
    ];
  }

  #curves() {
    return this.data.curves.map((curve) => {
      const side = curve.direction > 0 ? "up" : "down";
      const line = (values) => curve.x.map((value, index) => `${this.x(value).toFixed(1)},${this.y(values[index]).toFixed(1)}`);
      return [
        curve.low && s("path", { class: `band ${side}`, d: `M${[...line(curve.low), ...line(curve.high).reverse()].join("L")}Z` }),
        s("path", { class: `curve ${side}`, d: `M${line(curve.y).join("L")}` }),
      ];
    });
  }

  #points() {
    const { data } = this;
    const paths = { up: [], down: [], "up flagged": [], "down flagged": [] };
    const many = data.x.length > MANY;
    const size = many ? 2 : 4.2;
    for (let index = 0; index < data.x.length; index += 1) {
      const value = data.x[index];
      if (value === null || value < this.x.low || value > this.x.high) continue;
      const up = data.direction[index] > 0;
      paths[`${up ? "up" : "down"}${data.fitted[index] ? "" : " flagged"}`].push(triangle(this.x(value), this.y(data.y[index]), up ? size : -size));
    }
    return Object.entries(paths).map(([look, marks]) => marks.length > 0 && s("path", { class: `mark ${look}${many ? " many" : ""}`, d: marks.join("") }));
  }

  #drawRings() {
    if (!this.ringed) return;
    const { data } = this;
    const shown = this.rings.slice(0, MOST_RINGS).filter((index) => data.x[index] !== null);
    fill(this.ringed,
      this.crossed && shown.slice(0, 1).map((index) => s("line", { class: "cross", x1: this.x(data.x[index]), x2: this.x(data.x[index]), y1: MARGIN.top, y2: this.y(this.y.low) })),
      shown.map((index) => s("circle", { class: "ring", cx: this.x(data.x[index]), cy: this.y(data.y[index]), r: 7 })),
    );
  }

  #nearest(event) {
    const box = this.element.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    let best = null;
    let distance = REACH ** 2;
    for (let index = 0; index < this.data.x.length; index += 1) {
      if (this.data.x[index] === null) continue;
      const far = (this.x(this.data.x[index]) - x) ** 2 + (this.y(this.data.y[index]) - y) ** 2;
      if (far < distance) [best, distance] = [index, far];
    }
    return best;
  }

  #moved(event) {
    if (!this.data) return;
    if (this.from !== undefined) {
      this.#select(event);
      return;
    }
    this.at = this.#nearest(event);
    this.told.marked(this.at);
  }

  #left() {
    if (this.from === undefined) this.told.marked(null);
  }

  #pressed(event) {
    if (event.button !== 0 || !this.data) return;
    this.element.setPointerCapture(event.pointerId);
    this.from = event.clientX - this.element.getBoundingClientRect().left;
    this.to = this.from;
  }

  #select(event) {
    this.to = event.clientX - this.element.getBoundingClientRect().left;
    const [left, right] = [this.from, this.to].sort((one, other) => one - other);
    this.selection.setAttribute("x", left);
    this.selection.setAttribute("width", right - left);
  }

  #released(event) {
    if (this.from === undefined) return;
    const [left, right] = [this.from, this.to].sort((one, other) => one - other);
    this.from = undefined;
    this.selection.setAttribute("width", 0);
    if (right - left < SHORTEST_DRAG) {
      this.at = this.#nearest(event);
      this.told.pinned(this.at);
    } else if (!this.data.labels) {
      this.told.zoomed([Math.max(this.x.low, this.x.value(left)), Math.min(this.x.high, this.x.value(right))]);
    }
  }

  #typed(event) {
    if (!this.data) return;
    const steps = { ArrowRight: 1, ArrowLeft: -1, PageDown: 10, PageUp: -10 };
    if (event.key in steps) this.#step(steps[event.key]);
    else if (event.key === "ArrowUp" || event.key === "ArrowDown") this.#otherAtSamePlace(event.key === "ArrowUp");
    else if (event.key === "Home") this.#go(this.#order()[0]);
    else if (event.key === "End") this.#go(this.#order().at(-1));
    else if (event.key === "Enter" || event.key === " ") this.told.pinned(this.at);
    else if (event.key === "Escape") {
      this.at = null;
      this.told.pinned(null);
    } else if (event.key === "+" || event.key === "-") this.#closer(event.key === "+" ? 0.5 : 2);
    else return;
    event.preventDefault();
  }

  #order() {
    const { data } = this;
    return [...data.x.keys()].filter((index) => data.x[index] !== null).sort((one, other) => data.x[one] - data.x[other] || data.y[one] - data.y[other]);
  }

  #step(by) {
    const order = this.#order();
    const now = this.at === null ? -Math.sign(by) : order.indexOf(this.at);
    this.#go(order[Math.max(0, Math.min(order.length - 1, this.at === null && by < 0 ? order.length - 1 : now + by))]);
  }

  #otherAtSamePlace(higher) {
    if (this.at === null) return;
    const { x, y } = this.data;
    const beyond = [...x.keys()].filter((index) => x[index] === x[this.at] && (higher ? y[index] > y[this.at] : y[index] < y[this.at]));
    if (beyond.length) this.#go(beyond.reduce((best, index) => (Math.abs(y[index] - y[this.at]) < Math.abs(y[best] - y[this.at]) ? index : best)));
  }

  #go(index) {
    this.at = index;
    this.told.marked(index);
  }

  #closer(factor) {
    if (this.data.labels) return;
    const middle = this.at === null ? (this.x.low + this.x.high) / 2 : this.data.x[this.at];
    const half = ((this.x.high - this.x.low) / 2) * factor;
    const [first, last] = extent(this.data.x, 0.015);
    const range = [Math.max(first, middle - half), Math.min(last, middle + half)];
    this.told.zoomed(range[0] <= first && range[1] >= last ? null : range);
  }
}

/** Return a triangle about a place, upwards for a positive size. */
function triangle(x, y, size) {
  const wide = Math.abs(size);
  return `M${(x - wide).toFixed(1)},${(y + size * 0.8).toFixed(1)}h${(2 * wide).toFixed(1)}L${x.toFixed(1)},${(y - size).toFixed(1)}z`;
}
