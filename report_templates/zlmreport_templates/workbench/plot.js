// A graph of single readings with curves and bands, drawn as SVG. Directions differ by shape, line and colour;
// the look stands in the style sheet. What is done with mouse, finger and keys stands in pointing.js.

import { fill, h, s } from "./dom.js";
import { ALL_DIGITS } from "./number.js";
import { pointing } from "./pointing.js";
import { extent, scale, ticks } from "./scale.js";

const MARGIN = { left: 50, right: 14, top: 8, bottom: 34 };
// A line of a title, and how wide a letter of it is at most on the average.
const TITLE = 15;
const LETTER = 6.4;
const DIGIT = 7;
const REACH = 26;
const MOST_RINGS = 600;
const WIDTH_OF_TICK = 84;
const HEIGHT_OF_TICK = 38;
// One number alone gives a low graph no scale.
const FEWEST_TICKS = 5;
// So high and wide is a number at the end of a curve.
const LABEL = 13;
const MANY = 2000;
let count = 0;

export class Plot {
  /** `told` holds what is called: `marked` and `pinned` with a reading, `zoomed` with ranges, `boxed` with readings. */
  constructor({ label, hint, number, ...told }) {
    this.number = number;
    this.told = told;
    this.mode = "zoom";
    this.identifier = `plot-${(count += 1)}`;
    this.svg = s("svg", { "aria-hidden": "true", focusable: "false" });
    this.text = h("p", { class: "unseen", id: `${this.identifier}-text` });
    this.element = h("div", {
      class: "plot", tabindex: "0", role: "application", "aria-label": label,
      "aria-describedby": `${this.identifier}-text ${hint}`, ...pointing(this),
    }, this.svg, this.text);
    this.rings = [];
    this.at = null;
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  /**
   * Show readings (`x`, `y`, `direction`, `fitted` arrays), curves, bands, and the level of the noise; what was
   * before (`ghost`: curves and `y`), curves of other tests, lines, a look for each reading; `range` and `span` are
   * what is in sight.
   */
  show(data) {
    this.data = data;
    this.rings = []; // those of other readings
    this.text.textContent = data.alternative;
    this.#draw();
  }

  /** Ring readings, by their indices; the first of them has a line down to its axis if `crossed`. */
  ring(indices, crossed) {
    this.rings = indices;
    this.crossed = crossed;
    this.#drawRings();
  }

  /** Return the whole range of an axis, `x` or `y`, with the room that it is drawn with. */
  whole(axis) {
    const { data } = this;
    return axis === "x" ? extent(data.x, data.labels ? 0.35 : 0.015) : extent(this.#heights(-Infinity, Infinity), 0.06);
  }

  /** Return which readings are in sight, within a box of values if there is one. */
  within(box = { x: [this.x.low, this.x.high], y: [this.y.low, this.y.high] }) {
    const { x, y } = this.data;
    const inside = (value, [low, high]) => value !== null && value >= low && value <= high;
    return [...x.keys()].filter((index) => this.#isShown(index) && inside(x[index], box.x) && inside(y[index], box.y));
  }

  /** Return the reading nearest to a place on the screen; null where none is near. */
  nearest({ x, y }) {
    let best = null;
    let distance = REACH ** 2;
    for (let index = 0; index < this.data.x.length; index += 1) {
      if (this.data.x[index] === null || !this.#isShown(index)) continue;
      const far = (this.x(this.data.x[index]) - x) ** 2 + (this.y(this.data.y[index]) - y) ** 2;
      if (far < distance) [best, distance] = [index, far];
    }
    return best;
  }

  /** Show the box that is being drawn, from one corner on the screen to the other; none for none. */
  select(from, to) {
    const at = from ? { x: Math.min(from.x, to.x), y: Math.min(from.y, to.y), width: Math.abs(from.x - to.x), height: Math.abs(from.y - to.y) } : { width: 0, height: 0 };
    for (const [name, value] of Object.entries(at)) this.selection.setAttribute(name, value);
  }

  #isShown(index) {
    return !this.data.hidden.has(this.data.direction[index] > 0 ? "up" : "down");
  }

  /** Return all heights that are drawn between two places of the axis. */
  #heights(low, high) {
    const { data } = this;
    const found = data.noise ? [data.noise, -data.noise] : [];
    for (let index = 0; index < data.x.length; index += 1) {
      if (data.x[index] >= low && data.x[index] <= high && this.#isShown(index)) {
        found.push(data.y[index]);
        if (data.ghost) found.push(data.ghost.y[index]);
      }
    }
    for (const curve of [...this.#curvesShown(), ...this.#othersShown()]) {
      for (let index = 0; index < curve.x.length; index += 1) {
        if (curve.x[index] >= low && curve.x[index] <= high) found.push(curve.y[index], curve.low ? curve.low[index] : curve.y[index], curve.high ? curve.high[index] : curve.y[index]);
      }
    }
    return found;
  }

  #curvesShown() {
    return this.data.curves.filter((curve) => !this.data.hidden.has(curve.direction > 0 ? "model-up" : "model-down"));
  }

  /** Return the curves of other tests, those of a direction that is hidden left out. */
  #othersShown() {
    return (this.data.others ?? []).filter((curve) => !this.data.hidden.has(curve.direction > 0 ? "up" : "down"));
  }

  #draw() {
    const width = this.element.clientWidth;
    const height = this.element.clientHeight;
    if (!this.data || width < 80 || height < 60) return;
    const { data } = this;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const [first, last] = data.range ?? this.whole("x");
    const [low, high] = data.span ?? extent(data.range ? this.#heights(first, last) : this.#heights(-Infinity, Infinity), 0.06);
    const below = MARGIN.bottom + (this.#titlesMeet(width) ? TITLE : 0);
    this.y = scale(low, high, height - below, MARGIN.top);
    const levels = ticks(this.y.low, this.y.high, Math.max(FEWEST_TICKS, (height - MARGIN.top - below) / HEIGHT_OF_TICK))
      .map((value) => [value, this.number(value, ALL_DIGITS)]);
    // Numbers of many digits have the room that they need: 10⁷ µm, of a file in another unit, was cut.
    const left = Math.max(MARGIN.left, Math.max(...levels.map(([, label]) => label.length)) * DIGIT + 8);
    this.x = scale(first, last, left, width - MARGIN.right);
    const inside = { x: left, y: MARGIN.top, width: width - left - MARGIN.right, height: height - MARGIN.top - below };
    this.ringed = s("g", { class: "rings" });
    this.selection = s("rect", { class: "selection", x: 0, y: 0, width: 0, height: 0 });
    fill(this.svg,
      s("clipPath", { id: this.identifier }, s("rect", inside)),
      this.#axes(inside, height, levels),
      s("g", { "clip-path": `url(#${this.identifier})` }, this.#levels(inside), this.#ghost(), this.#curves(this.#curvesShown(), ""), this.#others(), this.#points(data.y, ""), this.#lines(), this.ringed, this.selection),
    );
    this.#drawRings();
  }

  /** Return whether both titles are too long for one line: then that of the readings stands below the other. */
  #titlesMeet(width) {
    return (this.data.xTitle.length + this.data.yTitle.length + 2) * LETTER > width - MARGIN.right;
  }

  #axes(inside, height, levels) {
    const { data, x, y } = this;
    const bottom = inside.y + inside.height;
    const across = data.labels
      ? [...data.labels].map(([value, label]) => [value, label])
      : ticks(x.low, x.high, inside.width / WIDTH_OF_TICK).map((value) => [value, this.number(value, ALL_DIGITS)]);
    return s("g", { class: "axes" },
      s("rect", { class: "frame", ...inside }),
      levels.map(([value, label]) => [
        s("line", { class: value === 0 ? "zero" : "grid", x1: inside.x, x2: inside.x + inside.width, y1: y(value), y2: y(value) }),
        s("text", { class: "tick", x: inside.x - 7, y: y(value) + 4, "text-anchor": "end" }, label),
      ]),
      across.map(([value, label]) => [
        s("line", { class: "grid", x1: x(value), x2: x(value), y1: inside.y, y2: bottom }),
        s("text", { class: "tick", x: x(value), y: bottom + 15, "text-anchor": "middle" }, label),
      ]),
      s("text", { class: "title", x: inside.x + inside.width, y: bottom + MARGIN.bottom - 4, "text-anchor": "end" }, data.xTitle),
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

  /** What was there before a step, behind what is there after it. */
  #ghost() {
    const { ghost } = this.data;
    return ghost ? [this.#curves(ghost.curves, " ghost"), ghost.y !== this.data.y && this.#points(ghost.y, " ghost")] : [];
  }

  #curves(curves, look) {
    return curves.map((curve) => {
      const side = curve.direction > 0 ? "up" : "down";
      const line = (values) => curve.x.map((value, index) => `${this.x(value).toFixed(1)},${this.y(values[index]).toFixed(1)}`);
      return [
        curve.low && !look && s("path", { class: `band ${side}`, d: `M${[...line(curve.low), ...line(curve.high).reverse()].join("L")}Z` }),
        s("path", { class: `curve ${side}${look}`, d: `M${line(curve.y).join("L")}` }),
      ];
    });
  }

  /** The means of other tests, each with its number at its end: nothing is told by colour alone. */
  #others() {
    const taken = [];
    return this.#othersShown().filter((curve) => curve.x.length > 0).map((curve) => {
      const x = this.x(curve.x.at(-1)) - 8;
      let y = this.y(curve.y.at(-1)) - 5;
      while (taken.some((other) => Math.abs(other.x - x) < LABEL && Math.abs(other.y - y) < LABEL)) y += LABEL;
      taken.push({ x, y });
      return [this.#curves([curve], ` ${curve.look}`), s("text", { class: `label ${curve.look}`, x, y }, curve.label)];
    });
  }

  #points(heights, look) {
    const { data } = this;
    const paths = new Map();
    const many = data.x.length > MANY;
    const size = many ? 2 : 4.2;
    for (let index = 0; index < data.x.length; index += 1) {
      const value = data.x[index];
      if (value === null || value < this.x.low || value > this.x.high || !this.#isShown(index)) continue;
      const up = data.direction[index] > 0;
      const flagged = data.fitted[index] ? "" : " flagged";
      const shade = look || flagged || !data.shades ? "" : ` ${data.shades[index]}`;
      const name = `mark ${up ? "up" : "down"}${flagged}${shade}${many ? " many" : ""}${look}`;
      if (!paths.has(name)) paths.set(name, []);
      paths.get(name).push(triangle(this.x(value), this.y(heights[index]), up ? size : -size));
    }
    return [...paths].map(([name, marks]) => s("path", { class: name, d: marks.join("") }));
  }

  /** Lines through passes: each from one place of the axis to another. */
  #lines() {
    return (this.data.lines ?? []).filter(({ direction }) => !this.data.hidden.has(direction > 0 ? "up" : "down"))
      .map(({ from, to, direction }) => s("line", { class: `pass ${direction > 0 ? "up" : "down"}`, x1: this.x(from[0]), y1: this.y(from[1]), x2: this.x(to[0]), y2: this.y(to[1]) }));
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
}

/** Return straight lines through the readings of each pass (`run` and direction) over an axis, with their slopes. */
export function passes(x, y, run, direction) {
  const groups = new Map();
  x.forEach((value, index) => {
    if (value === null) return;
    const name = `${run[index]} ${direction[index]}`;
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push(index);
  });
  return [...groups.values()].filter((group) => group.length > 2).flatMap((group) => {
    const mean = (values) => group.reduce((sum, index) => sum + values[index], 0) / group.length;
    const [middle, level] = [mean(x), mean(y)];
    const spread = group.reduce((sum, index) => sum + (x[index] - middle) ** 2, 0);
    if (!(spread > 0)) return [];
    const slope = group.reduce((sum, index) => sum + (x[index] - middle) * (y[index] - level), 0) / spread;
    const [first, last] = extent(group.map((index) => x[index]));
    const at = (value) => [value, level + slope * (value - middle)];
    return [{ run: run[group[0]], direction: direction[group[0]], slope, from: at(first), to: at(last) }];
  });
}

/** Return a triangle about a place, upwards for a positive size. */
function triangle(x, y, size) {
  const wide = Math.abs(size);
  return `M${(x - wide).toFixed(1)},${(y + size * 0.8).toFixed(1)}h${(2 * wide).toFixed(1)}L${x.toFixed(1)},${(y - size).toFixed(1)}z`;
}
