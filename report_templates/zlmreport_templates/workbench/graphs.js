// The two graphs and what is said of the reading that is pointed at: one reading is marked in both.

import { fill, h } from "./dom.js";
import { Plot } from "./plot.js";

const ARROWS = new Map([[-1, "↓"], [1, "↑"]]);
const GOLDEN = 0.618034;

export class Graphs {
  /** `texts` are the words of the page, `number` writes numbers, `exclude` sets a reading aside for a reason. */
  constructor(texts, number, exclude) {
    Object.assign(this, { texts, number, exclude });
    this.over = "position";
    this.range = null;
    this.marked = null;
    this.pinned = null;
    this.shown = [];
    const told = {
      number,
      hint: "hint",
      marked: (index) => this.#mark(index),
      pinned: (index) => this.#pin(index),
      zoomed: (range) => this.#zoom(range),
    };
    this.above = new Plot({ ...told, label: texts.measured });
    this.below = new Plot({ ...told, label: texts.residuals });
    this.choice = h("select", { id: "over", change: () => this.#switch(this.choice.value) });
    this.whole = h("button", { type: "button", class: "quiet", hidden: true, "data-key": "whole", click: () => this.#zoom(null) }, texts.reset);
    this.reading = h("div", { class: "reading", role: "status" });
    this.element = h("section", { class: "graphs", "aria-labelledby": "measured" },
      h("div", { class: "heading" }, h("h2", { id: "measured" }, texts.measured), this.#legend(), this.whole),
      this.above.element,
      h("div", { class: "heading" },
        h("h2", {}, texts.residuals),
        h("label", { for: "over" }, texts.over), this.choice,
        h("ul", { class: "legend" }, h("li", { class: "of-noise" }, texts.noise))),
      this.below.element,
      h("p", { id: "hint", class: "unseen" }, texts.point),
      this.reading,
    );
  }

  /** Show the readings and the model of a job. */
  show(graphs) {
    const pinned = this.graphs?.readings.place[this.pinned];
    this.pinned = graphs.readings.place.indexOf(pinned);
    if (this.pinned < 0) this.pinned = null;
    this.marked = null;
    delete this.reading.dataset.form;
    this.graphs = graphs;
    this.axes = new Map(graphs.axes.map((axis) => [axis.key, axis]));
    if (!this.axes.has(this.over)) this.over = "position";
    fill(this.choice, graphs.axes.map((axis) => h("option", { value: axis.key, selected: axis.key === this.over }, axis.title)));
    this.places = new Map(graphs.readings.place.map((place, index) => [place, index]));
    this.shown = [];
    this.#draw();
    this.#say();
  }

  /** Mark the readings that show something, over what shows it best. */
  point(axis, places) {
    this.pinned = null;
    this.range = null;
    if (this.axes.has(axis)) this.#switch(axis);
    this.shown = (places.length ? places : []).map((place) => this.places.get(place)).filter((index) => index !== undefined);
    this.#draw();
    this.element.scrollIntoView({ block: "nearest", behavior: "smooth" });
    this.below.element.focus({ preventScroll: true });
    this.#say();
  }

  #legend() {
    const { texts } = this;
    return h("ul", { class: "legend" }, [["up", texts.upwards], ["down", texts.downwards], ["model-up", texts.modelUp], ["model-down", texts.modelDown]]
      .map(([look, name]) => h("li", { class: `of-${look}` }, name)));
  }

  #draw() {
    const { graphs } = this;
    const { readings } = graphs;
    const position = this.axes.get("position");
    const alike = { direction: readings.direction, fitted: readings.fitted, alternative: graphs.alternative };
    this.above.show({
      ...alike, x: position.values, y: readings.deviation, curves: graphs.model, noise: null, range: this.range,
      xTitle: titled(position), yTitle: `${graphs.deviation} (${graphs.unit})`,
    });
    const axis = this.axes.get(this.over);
    const labels = this.over === "direction" ? ARROWS : null;
    this.below.show({
      ...alike, x: spread(axis, readings.place), y: readings.residual, curves: [], noise: graphs.noise, labels,
      range: this.over === "position" ? this.range : null,
      xTitle: titled(axis), yTitle: `${graphs.residual} (${graphs.unit})`,
    });
    this.whole.hidden = this.range === null;
    this.#rings();
  }

  #rings() {
    const one = this.marked ?? this.pinned;
    const rings = one === null ? this.shown : [one, ...this.shown.filter((index) => index !== one)];
    for (const plot of [this.above, this.below]) plot.ring(rings, one !== null);
  }

  #switch(axis) {
    this.over = axis;
    this.choice.value = axis;
    this.#draw();
  }

  #zoom(range) {
    if (range !== null && this.over !== "position") return;
    this.range = range;
    this.#draw();
  }

  #mark(index) {
    if (index === this.marked) return;
    this.marked = index;
    for (const plot of [this.above, this.below]) plot.at = index ?? plot.at;
    this.#rings();
    this.#say();
  }

  #pin(index) {
    this.pinned = index;
    this.shown = [];
    this.#rings();
    this.#say();
  }

  /** Say which reading is marked; keep the form of the chosen one while others are pointed at. */
  #say() {
    const index = this.marked ?? this.pinned;
    if (index === null) {
      delete this.reading.dataset.form;
      fill(this.reading, h("p", { class: "hint" }, `${this.texts.point} ${this.texts.zoom}`));
      return;
    }
    const form = index === this.pinned && this.exclude ? this.#form(index) : null;
    if (form && this.reading.dataset.form === String(index)) return;
    if (form) this.reading.dataset.form = index;
    else delete this.reading.dataset.form;
    fill(this.reading, h("dl", {}, this.#facts(index).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value)))), form);
  }

  #facts(index) {
    const { texts, number, graphs } = this;
    const { readings } = graphs;
    const value = (axis) => `${number(axis.values[index])} ${axis.unit}`.trim();
    const deviation = (amount) => `${number(Math.round(100 * amount) / 100)} ${graphs.unit}`;
    const [position, ...others] = graphs.axes.filter((axis) => axis.key !== "direction" && axis.values[index] !== null);
    return [
      [texts.target, `${value(position)} ${ARROWS.get(readings.direction[index])}`],
      [texts.run, number(readings.run[index])],
      [texts.deviation, deviation(readings.deviation[index])],
      [texts.modelValue, deviation(readings.deviation[index] - readings.residual[index])],
      [texts.residual, deviation(readings.residual[index])],
      ...others.filter((axis) => axis.key !== "run").map((axis) => [axis.title, value(axis)]),
      ...(readings.fitted[index] ? [] : [["", texts.flagged]]),
    ];
  }

  #form(index) {
    const { texts, graphs } = this;
    const reason = h("input", { id: "reason", required: true, maxlength: 200, autocomplete: "off" });
    return h("form", {
      class: "aside",
      submit: (event) => {
        event.preventDefault();
        this.exclude(graphs.readings.place[index], reason.value.trim());
      },
    }, h("label", { for: "reason" }, texts.reason), reason, h("button", { type: "submit", "data-key": "exclude" }, texts.setAside));
  }
}

function titled(axis) {
  return axis.unit ? `${axis.title} (${axis.unit})` : axis.title;
}

/** Return the values of an axis; those of few different ones spread, so that readings do not hide each other. */
function spread(axis, places) {
  const widths = { direction: 0.5, run: 0.3 };
  const width = widths[axis.key];
  if (!width) return axis.values;
  return axis.values.map((value, index) => value + (((places[index] * GOLDEN) % 1) - 0.5) * width);
}
