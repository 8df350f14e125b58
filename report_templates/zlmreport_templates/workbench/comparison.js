// Several tests of one axis: their means over the readings, what differs, parameters over the days, models.

import { fill, h, named, s, symbol } from "./dom.js";
import { ALL_DIGITS, shortened, withUnit } from "./number.js";
import { Plot } from "./plot.js";
import { extent, scale } from "./scale.js";

const ARROWS = new Map([[-1, "↓"], [1, "↑"]]);
const LOOKS = 6;
const TREND = { width: 132, height: 30, room: 6 };

export class Comparison {
  /** `laid` is told which curves are to be laid over the readings. */
  constructor(texts, number, laid) {
    Object.assign(this, { texts, number, laid });
    this.element = h("section", { class: "panel", id: "part-tests" });
    this.left = new Set();
    this.place = h("p", { class: "hint", role: "status" });
    this.plot = new Plot({
      label: texts.difference, number, hint: "hint",
      marked: (index) => this.#say(index), pinned: (index) => this.#say(index), boxed: () => {},
      zoomed: (look) => { this.look = look; this.#draw(); },
    });
  }

  /** Show the tests of an axis, as the server compares them, beside the graphs of the job. */
  show(found, graphs) {
    const { texts } = this;
    Object.assign(this, { found, graphs, look: null });
    const problems = found.problems.length > 0 && h("ul", { class: "problems" }, found.problems.map((each) => h("li", {}, each)));
    if (found.tests.length === 0) {
      fill(this.element, problems && [h("h2", {}, texts.tests), problems]);
      this.laid([]);
      return;
    }
    this.numbered = found.tests.map((test, index) => ({ ...test, count: index + 1, look: `test-${index % LOOKS}` }));
    this.whole = h("button", { type: "button", class: "quiet", hidden: true, click: () => { this.look = null; this.#draw(); } }, texts.reset);
    fill(this.element,
      h("div", { class: "heading" }, h("h2", {}, texts.tests), this.#legend(), this.whole), problems,
      h("h3", {}, texts.difference), this.plot.element, this.place,
      found.standards.map((standard, index) => h("details", { open: index === 0 }, h("summary", {}, `${standard.designation} · ${standard.unit}`), this.#parameters(standard))),
      found.models.length > 0 && h("details", { open: true }, h("summary", {}, texts.models), this.#models()));
    this.#draw();
  }

  #legend() {
    return h("ul", { class: "legend" }, this.numbered.map((test) => h("li", {}, test.isHere
      ? h("span", { class: "of-here" }, `${test.count} ${titled(test)} (${this.texts.thisTest})`)
      : h("button", { type: "button", class: `of-${test.look}`, "data-key": `test-${test.count}`, "aria-pressed": String(!this.left.has(test.name)), click: (event) => this.#toggle(test, event.currentTarget) }, `${test.count} ${titled(test)}`))));
  }

  #toggle(test, button) {
    if (!this.left.delete(test.name)) this.left.add(test.name);
    button.setAttribute("aria-pressed", String(!this.left.has(test.name)));
    this.#draw();
  }

  #draw() {
    const { graphs, texts } = this;
    const shown = this.numbered.filter((test) => !test.isHere && !this.left.has(test.name));
    const curves = (name) => shown.flatMap((test) => test.curves.map((curve) => ({
      direction: curve.direction, look: test.look, label: String(test.count), ...known(curve.x, curve[name]) })));
    const differences = curves("difference");
    const points = differences.flatMap((curve) => curve.x.map((x, index) => ({ x, y: curve.y[index], direction: curve.direction, look: curve.look, name: curve.label })));
    this.points = points;
    this.whole.hidden = this.look === null;
    this.plot.show({
      x: points.map(({ x }) => x), y: points.map(({ y }) => y), direction: points.map(({ direction }) => direction), fitted: points.map(() => true),
      shades: points.map(({ look }) => look), curves: [], others: differences, noise: null, hidden: new Set(), alternative: texts.differenceIs,
      range: this.look?.x ?? null, span: this.look?.y ?? null,
      xTitle: `${graphs.axes[0].title} (${graphs.axes[0].unit})`, yTitle: `${texts.difference} (${graphs.unit})`,
    });
    this.#say(null);
    this.laid(curves("y"));
  }

  #say(index) {
    const point = index === null ? null : this.points[index];
    fill(this.place, point
      ? named(titled(this.numbered[Number(point.name) - 1]), named(`${withUnit(this.number(point.x, ALL_DIGITS), this.graphs.axes[0].unit)} ${ARROWS.get(point.direction)}`, withUnit(this.number(shortened(point.y)), this.graphs.unit)))
      : this.texts.differenceIs);
  }

  #heading(...more) {
    return h("thead", {}, h("tr", {}, h("th", { scope: "col" }, this.texts.parameter), this.numbered.map((test) =>
      h("th", { scope: "col", class: "number" }, `${test.count} ${test.name}`, test.day && [h("br"), test.day])), more));
  }

  #parameters(standard) {
    return h("div", { class: "wide", tabindex: "0", role: "region", "aria-label": named(this.texts.tests, standard.designation) }, h("table", { class: "tests" },
      this.#heading(h("th", { scope: "col" }, this.texts.overDays)),
      h("tbody", {}, standard.rows.map((row) => h("tr", {},
        h("th", { scope: "row", title: row.name }, symbol(row.symbol), h("span", { class: "unseen" }, ` ${row.name}`)),
        row.cells.map(amount), h("td", {}, trend(row, this.numbered)))))));
  }

  #models() {
    return h("div", { class: "wide", tabindex: "0", role: "region", "aria-label": this.texts.models }, h("table", { class: "tests" },
      this.#heading(),
      h("tbody", {}, this.found.models.map((row) => h("tr", {},
        h("th", { scope: "row", title: row.description }, `${row.called} `, symbol(row.symbol)), row.cells.map(amount))))));
  }
}

function titled(test) {
  return test.day ? `${test.name}, ${test.day}` : test.name;
}

/** Return the places of a curve at which a value is known. */
function known(x, y) {
  const kept = [...x.keys()].filter((index) => y[index] !== null);
  return { x: kept.map((index) => x[index]), y: kept.map((index) => y[index]) };
}

function amount(cell) {
  return h("td", { class: "number" }, cell === null ? "–" : [cell.value, cell.uncertainty && h("span", { class: "quiet" }, ` ± ${cell.uncertainty}`), withUnit("", cell.unit)]);
}

/** Return a small graph of a parameter with its U over the days of the tests; over their order where a day is unknown. */
function trend(row, tests) {
  const days = tests.every((test) => test.day) ? tests.map((test) => Date.parse(test.day)) : [...tests.keys()];
  const spread = new Set(days).size === days.length ? days : [...tests.keys()];
  const cells = row.cells.map((cell, index) => ({ ...cell, at: spread[index] })).filter((cell) => Number.isFinite(cell.number));
  if (cells.length < 2) return null;
  const { width, height, room } = TREND;
  const heights = cells.flatMap((cell) => [cell.number - (cell.expanded ?? 0), cell.number + (cell.expanded ?? 0)]);
  const x = scale(Math.min(...spread), Math.max(...spread), room, width - room);
  const y = scale(...extent(row.limit === null ? heights : [...heights, row.limit]), height - room, room);
  return s("svg", { class: "trend", viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" },
    row.limit !== null && s("line", { class: "limit", x1: 0, x2: width, y1: y(row.limit), y2: y(row.limit) }),
    s("path", { class: "run", d: `M${cells.map((cell) => `${x(cell.at).toFixed(1)},${y(cell.number).toFixed(1)}`).join("L")}` }),
    cells.map((cell) => [
      cell.expanded > 0 && s("line", { class: "amount", x1: x(cell.at), x2: x(cell.at), y1: y(cell.number - cell.expanded), y2: y(cell.number + cell.expanded) }),
      s("circle", { cx: x(cell.at), cy: y(cell.number), r: 2.4 })]));
}
