// The two graphs and what is said of the reading that is pointed at: one reading is marked in both.

import { fill, h, named, said } from "./dom.js";
import { ALL_DIGITS, shortened, withUnit } from "./number.js";
import { Plot, passes } from "./plot.js";
import { saveCsv, savePng, saveSvg } from "./saving.js";
import { extent } from "./scale.js";

const ARROWS = ["↓", "↑"];
const GOLDEN = 0.618034;
const SERIES = [["up", "upwards"], ["down", "downwards"], ["model-up", "modelUp"], ["model-down", "modelDown"]];
const MODES = [["zoom", "modeZoom"], ["move", "modeMove"], ["select", "modeSelect"]];
const SHADES = 6;
const ROWS = 500;
const REST = 150;

export class Graphs {
  /**
   * `texts` are the words of the page, `number` writes numbers, `exclude` sets readings aside for a reason, and
   * `closer` returns the model's curves on a part of the axis, drawn for that part; either may be missing.
   */
  constructor(texts, number, exclude, closer) {
    Object.assign(this, { texts, number, exclude, closer });
    this.over = "position";
    this.shade = "direction";
    this.ranges = new Map();
    this.spans = new Map();
    this.hidden = new Set();
    this.marked = null;
    this.pinned = null;
    this.boxed = [];
    this.shown = [];
    this.step = null;
    this.others = [];
    this.near = null;
    this.above = this.#plot("above", texts.measured);
    this.below = this.#plot("below", texts.residuals);
    this.choice = h("select", { id: "over", "aria-label": `${texts.residuals} ${texts.over}`, change: () => this.#switch(this.choice.value) });
    this.colour = h("select", { id: "colour", change: () => { this.shade = this.colour.value; this.#draw(); } });
    this.whole = h("button", { type: "button", class: "quiet", hidden: true, "data-key": "whole", click: () => this.#zoom(null) }, texts.reset);
    this.reading = h("div", { class: "reading", role: "status" });
    this.table = h("details", { class: "table", toggle: () => this.#list() }, h("summary", {}, texts.asTable), h("div", { class: "wide", tabindex: "0", role: "region", "aria-label": texts.asTable }));
    this.caption = h("p", { class: "caption", hidden: true });
    this.reach = h("p", { class: "quiet", hidden: true }, texts.reach);
    this.element = h("section", { class: "graphs", "aria-labelledby": "measured" },
      h("div", { class: "heading" }, h("h2", { id: "measured" }, texts.measured), this.#legend(), this.whole),
      h("div", { class: "captioned" }, this.caption, this.above.element),
      this.reach,
      h("div", { class: "heading" },
        h("h2", {}, texts.residuals),
        h("label", { for: "over" }, texts.over), this.choice,
        h("label", { for: "colour" }, texts.colour), this.colour,
        this.noise = h("ul", { class: "legend" }, h("li", { class: "of-noise" }, texts.noise))),
      this.below.element,
      h("div", { class: "heading tools" }, this.#modes(), this.#save()),
      h("p", { id: "hint", class: "unseen" }, texts.point),
      this.reading,
      this.table,
    );
  }

  /** Show the readings and the model of a job. */
  show(graphs) {
    const pinned = this.graphs?.readings.place[this.pinned];
    this.pinned = graphs.readings.place.indexOf(pinned);
    if (this.pinned < 0) this.pinned = null;
    this.marked = null;
    this.boxed = [];
    this.step = null;
    this.near = null;
    delete this.reading.dataset.form;
    this.graphs = graphs;
    this.axes = new Map(graphs.axes.map((axis) => [axis.key, axis]));
    const [back, forth] = graphs.arrows ?? ARROWS;
    this.arrows = new Map([[-1, back], [1, forth]]);
    if (!this.axes.has(this.over)) this.over = "position";
    if (!this.axes.has(this.shade)) this.shade = "direction";
    fill(this.choice, graphs.axes.map((axis) => h("option", { value: axis.key, selected: axis.key === this.over }, axis.title)));
    fill(this.colour, [["direction", this.texts.direction], ...graphs.axes.filter(({ key }) => key !== "direction").map(({ key, title }) => [key, title])]
      .map(([key, title]) => h("option", { value: key, selected: key === this.shade }, title)));
    this.places = new Map(graphs.readings.place.map((place, index) => [place, index]));
    this.shown = [];
    this.#draw();
    this.#say();
  }

  /** Return the room that a reading's values take, kept free: so nothing below moves when one is pointed at. */
  #room() {
    return this.graphs?.readings.place.length > 0 && h("div", { class: "room", "aria-hidden": "true" }, this.#values(0));
  }

  #values(index) {
    return h("dl", {}, this.#facts(index).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
  }

  /** Show what a step of the model does: `before` and `after` it, each a model and residuals; null for neither. */
  compare(step, name = "") {
    this.step = step;
    this.caption.hidden = step === null;
    fill(this.caption, step && [h("span", { class: "of-before" }, this.texts.before), " ", h("span", { class: "of-after" }, said(this.texts.after, { step: name }))]);
    this.#draw();
  }

  /** Lay the means of other tests over the readings. */
  overlay(curves) {
    this.others = curves;
    if (this.graphs) this.#draw();
  }

  /** Mark the readings that show something, over what shows it best. */
  point(axis, places) {
    this.pinned = null;
    this.ranges.clear();
    this.spans.clear();
    if (this.axes.has(axis)) this.#switch(axis);
    this.near = null;
    this.shown = this.#indices(places);
    this.#draw();
    this.element.scrollIntoView({ block: "nearest", behavior: "smooth" });
    this.below.element.focus({ preventScroll: true });
    this.#say();
  }

  /** Ring readings by their places, without leaving where one is. */
  ring(places) {
    this.shown = this.#indices(places);
    this.#rings();
  }

  #indices(places) {
    return places.map((place) => this.places.get(place)).filter((index) => index !== undefined);
  }

  #plot(name, label) {
    return new Plot({
      label,
      number: this.number,
      hint: "hint",
      marked: (index) => this.#mark(index),
      pinned: (index) => this.#pin(index),
      boxed: (indices) => this.#box(indices),
      zoomed: (look) => this.#zoom(look, name),
    });
  }

  #legend() {
    return h("ul", { class: "legend" }, SERIES.map(([look, name]) => h("li", {},
      h("button", { type: "button", class: `of-${look}`, "aria-pressed": "true", click: (event) => this.#toggle(look, event.currentTarget) }, this.texts[name]))));
  }

  #toggle(look, button) {
    if (!this.hidden.delete(look)) this.hidden.add(look);
    button.setAttribute("aria-pressed", String(!this.hidden.has(look)));
    this.#draw();
  }

  #modes() {
    const buttons = MODES.map(([mode, name]) => h("button", { type: "button", "aria-pressed": String(mode === "zoom"), click: () => {
      for (const plot of [this.above, this.below]) plot.mode = mode;
      for (const each of buttons) each.setAttribute("aria-pressed", String(each.value === mode));
    }, value: mode }, this.texts[name]));
    return h("div", { class: "modes", role: "group", "aria-label": this.texts.mode }, buttons);
  }

  #save() {
    const { texts } = this;
    const button = (label, work) => h("button", { type: "button", click: work }, label);
    return h("details", { class: "save" }, h("summary", {}, texts.save), h("div", {},
      [[this.above, texts.measured, "deviations"], [this.below, texts.residuals, "residuals"]].map(([plot, title, name]) => h("p", {},
        named(title), button("PNG", () => savePng(plot, name)), " ", button("SVG", () => saveSvg(plot, name)))),
      h("p", {}, named(texts.inSight), button("CSV", () => saveCsv(this.#rows(this.above.within()), "readings")))));
  }

  #draw() {
    const { graphs, step } = this;
    const { readings } = graphs;
    const position = this.axes.get("position");
    const alike = { direction: readings.direction, fitted: readings.fitted, alternative: graphs.alternative, hidden: this.hidden, shades: this.#shades() };
    const curves = step ? step.after.model : this.near?.model ?? graphs.model;
    this.noise.hidden = graphs.noise === null;
    this.reach.hidden = !(this.near?.model ?? graphs.model).some((each) => each.reach);
    this.above.show({
      ...alike, x: position.values, y: readings.deviation, curves, others: this.others, noise: null,
      ghost: step && { curves: step.before.model, y: readings.deviation },
      range: this.ranges.get("position") ?? null, span: this.spans.get("above") ?? null,
      xTitle: titled(position), yTitle: `${graphs.deviation} (${graphs.unit})`,
    });
    const axis = this.axes.get(this.over);
    const x = spread(axis, readings.place);
    const residual = step ? step.after.residual : readings.residual;
    this.passes = this.over === "time" ? passes(x, residual, readings.run, readings.direction) : [];
    this.below.show({
      ...alike, x, y: residual, curves: [], noise: graphs.noise, labels: this.over === "direction" ? this.arrows : null,
      ghost: step && { curves: [], y: step.before.residual }, lines: this.passes,
      range: this.ranges.get(this.over) ?? null, span: this.spans.get("below") ?? null,
      xTitle: titled(axis), yTitle: `${graphs.residual} (${graphs.unit})`,
    });
    this.whole.hidden = this.ranges.size + this.spans.size === 0;
    this.#rings();
    this.#list();
  }

  /** Return the class of colour of each reading: a sixth of the range of what was chosen; null for directions. */
  #shades() {
    if (this.shade === "direction") return null;
    const { values } = this.axes.get(this.shade);
    const [low, high] = extent(values);
    return values.map((value) => `shade-${value === null ? 0 : Math.min(SHADES - 1, Math.floor((SHADES * (value - low)) / (high - low || 1)))}`);
  }

  #rings() {
    const one = this.marked ?? this.pinned;
    const rest = [...this.boxed, ...this.shown];
    const rings = one === null ? rest : [one, ...rest.filter((index) => index !== one)];
    for (const plot of [this.above, this.below]) plot.ring(rings, one !== null);
  }

  #switch(axis) {
    this.over = axis;
    this.choice.value = axis;
    this.spans.delete("below");
    this.#draw();
  }

  #zoom(look, name = "") {
    const axis = name === "below" ? this.over : "position";
    if (look === null) {
      this.ranges.clear();
      this.spans.clear();
    } else {
      if (look.x) this.ranges.set(axis, look.x);
      else this.ranges.delete(axis);
      if (look.y) this.spans.set(name, look.y);
      else this.spans.clear();
    }
    this.near = null;
    this.#draw();
    this.#look();
  }

  /** Have the model drawn anew for the part of the axis that is in sight, once nothing moves any more. */
  #look() {
    clearTimeout(this.waiting);
    const range = this.ranges.get("position");
    if (!range || !this.closer) return;
    const { graphs } = this;
    this.waiting = setTimeout(async () => {
      const near = await this.closer(range);
      if (near === null || this.graphs !== graphs || this.ranges.get("position") !== range) return;
      this.near = near;
      this.#draw();
    }, REST);
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
    this.boxed = [];
    this.shown = [];
    this.#rings();
    this.#say();
  }

  #box(indices) {
    this.pinned = null;
    this.boxed = indices;
    this.shown = [];
    this.#rings();
    this.#say();
  }

  /** Say which reading is marked; keep the form of the chosen ones while others are pointed at. */
  #say() {
    const index = this.marked ?? this.pinned;
    const chosen = this.pinned === null ? this.boxed : [this.pinned];
    if (index === null && chosen.length === 0) {
      delete this.reading.dataset.form;
      fill(this.reading, h("p", { class: "hint" }, `${this.texts.point} ${this.texts.zoom}`), this.#room());
      return;
    }
    const key = chosen.join(" ");
    const form = this.exclude && chosen.length > 0 && (index === null || index === this.pinned) ? this.#form(chosen) : null;
    if (form && this.reading.dataset.form === key) return;
    if (form) this.reading.dataset.form = key;
    else delete this.reading.dataset.form;
    fill(this.reading, index === null
      ? h("p", {}, chosen.length === 1 ? this.texts.chosenOne : said(this.texts.chosen, { count: chosen.length }))
      : this.#values(index), form);
  }

  #facts(index) {
    const { texts, number, graphs } = this;
    const { readings } = graphs;
    const value = (axis, digits) => withUnit(number(axis.values[index], digits), axis.unit);
    const deviation = (amount) => withUnit(number(shortened(amount)), graphs.unit);
    const [position, ...others] = graphs.axes.filter((axis) => axis.key !== "direction" && axis.values[index] !== null);
    const pass = this.passes.find(({ run, direction }) => run === readings.run[index] && direction === readings.direction[index]);
    return [
      [texts.target, `${value(position, ALL_DIGITS)} ${this.arrows.get(readings.direction[index])}`],
      [texts.run, number(readings.run[index])],
      [texts.deviation, deviation(readings.deviation[index])],
      [texts.modelValue, deviation(readings.deviation[index] - readings.residual[index])],
      [texts.residual, deviation(readings.residual[index])],
      ...others.filter((axis) => axis.key !== "run").map((axis) => [axis.title, value(axis)]),
      ...(pass ? [[texts.slope, withUnit(number(Number(pass.slope.toPrecision(3))), `${graphs.unit}${this.axes.get("time").unit && `/${this.axes.get("time").unit}`}`)]] : []),
      ...(readings.fitted[index] ? [] : [["", texts.flagged]]),
    ];
  }

  #form(chosen) {
    const { texts, graphs } = this;
    const reason = h("input", { id: "reason", required: true, maxlength: 200, autocomplete: "off" });
    return h("form", {
      class: "aside",
      submit: (event) => {
        event.preventDefault();
        this.exclude(chosen.map((index) => graphs.readings.place[index]), reason.value.trim());
      },
    }, h("label", { for: "reason" }, texts.reason), reason, h("button", { type: "submit", "data-key": "exclude" }, chosen.length > 1 ? texts.setAllAside : texts.setAside));
  }

  /** Return a row of names and those of readings, by their indices. */
  #rows(indices) {
    const { texts, graphs } = this;
    const { readings } = graphs;
    const axes = graphs.axes.filter(({ key }) => key !== "direction" && key !== "run");
    return [
      [...axes.map(titled), texts.direction, texts.run, `${texts.deviation} (${graphs.unit})`, `${texts.modelValue} (${graphs.unit})`, `${texts.residual} (${graphs.unit})`],
      ...indices.map((index) => [
        ...axes.map((axis) => axis.values[index]), readings.direction[index] > 0 ? "+" : "-", readings.run[index],
        readings.deviation[index], Number((readings.deviation[index] - readings.residual[index]).toFixed(6)), readings.residual[index]]),
    ];
  }

  /** Write the readings in sight as a table, while it is open. */
  #list() {
    if (!this.table.open || !this.above.x) return;
    const [names, ...rows] = this.#rows(this.above.within());
    fill(this.table.lastElementChild, h("table", {},
      h("thead", {}, h("tr", {}, names.map((name) => h("th", { scope: "col", class: "number" }, name)))),
      h("tbody", {}, rows.slice(0, ROWS).map((row) => h("tr", {}, row.map((value, column) => h("td", { class: "number" }, typeof value === "number" ? this.number(value, column === 0 ? ALL_DIGITS : undefined) : value ?? "")))))),
      rows.length > ROWS && h("p", { class: "hint" }, said(this.texts.more, { count: rows.length - ROWS })));
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
