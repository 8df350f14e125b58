// The page of a machine: its tests against axes and effects, what is missing, the error as it falls.

import { blocks, section, table } from "./blocks.js";
import { fill, h, named } from "./dom.js";
import { Graphs } from "./graphs.js";
import { Loop } from "./loop.js";
import * as panels from "./panels.js";
import { Refusal, Silence, get, post, remembered } from "./server.js";
import { crossTables } from "./tables.js";

const PLACES = { certificate: "certificate", build: "stairs" };
const PARTS = ["verdict", "fall", "stairs", "failures", "candidates", "found", "hidden", "tables", "certificate", "effects", "steps", "preview", "sizes", "test", "machine"];
const OF_CIRCLE = "Circle";

export class MachinePage extends Loop {
  constructor(texts) {
    super(texts, PLACES);
    Object.assign(this.actions, {
      preview: (step, name) => this.#preview(step, name),
      wave: async () => null,
      tables: (wanted) => this.#tables(wanted),
      chooseTables: (wanted) => { this.wanted.tables = wanted; this.tables = null; this.#showTables(); },
      build: () => { this.made.set("build", { state: "made", stairs: this.diagnosis.diagnosis.stairs }); this.showMade(); },
    });
    this.parts = Object.fromEntries(PARTS.map((name) => [name, h("section", { class: "panel", id: `part-${name}` })]));
    this.shown = h("div", {});
    const { verdict, fall, stairs, failures, candidates, found, hidden, tables, certificate, effects, steps, preview, sizes, test, machine } = this.parts;
    document.body.replaceChildren(this.header, this.notice, this.spoken, h("main", {},
      h("div", { class: "bench machine" }, h("div", { class: "always" }, verdict, fall),
        h("div", { class: "seen" }, preview, sizes, this.shown, test, effects, machine),
        h("div", { class: "findings" }, stairs, candidates, failures, found, hidden, tables, certificate, steps))));
  }

  show(job) {
    this.job = job;
    this.stamp = job.stamp;
    this.diagnosis = null;
    this.results = null;
    this.previews = new Map();
    this.previewed = null;
    const { texts, parts, actions } = this;
    fill(this.header, ...this.heading(job));
    this.#showTest(job.tests.some((each) => each.test === this.test) ? this.test : job.tests[0]?.test);
    fill(parts.effects, panels.effects(texts, job, actions));
    fill(parts.failures, panels.failures(texts, job, (axis, places, each) => { this.#showTest(each.test); this.graphs.point(axis, places); }));
    fill(parts.steps, panels.steps(texts, job));
    this.showMade();
    this.showDiagnosis();
    this.#results(job.stamp);
    this.diagnose(job.stamp);
  }

  /** Show a test in the graphs, and in numbers as soon as they are known. */
  #showTest(name) {
    const values = this.job.tests.find((each) => each.test === name);
    if (!values) return;
    if (this.test !== name) {
      this.graphs = new Graphs(textsOf(this.texts, values), this.number);
      this.shown.replaceChildren(this.graphs.element);
      this.test = name;
    }
    this.graphs.show(values);
    this.graphs.compare(null);
    this.#showNumbers();
  }

  #showNumbers() {
    const { parts, texts, results } = this;
    if (!results) return;
    const several = this.job.tests.length > 1;
    const chosen = (cell) => h("button", { type: "button", class: "plain choice", "aria-pressed": String(cell.text === this.test), "data-key": `test-${cell.text}`, click: () => this.#showTest(cell.text) }, cell.text);
    fill(parts.sizes, several && [h("h2", {}, texts.tests), table(results.sizes, "", chosen)]);
    const title = this.job.tests.find((each) => each.test === this.test)?.title;
    fill(parts.test, results.tests[this.test] && [h("h2", {}, named(this.test, title)), blocks(results.tests[this.test])]);
  }

  /** Show what takes longer than the graphs. */
  async #results(stamp) {
    try {
      const results = await get("/api/results");
      if (this.stamp !== stamp) return;
      this.results = results;
      this.#showFall();
      fill(this.parts.machine, results.sections.map((each) => section(each, each.key === "errors")));
      this.#showNumbers();
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Silence)) throw error; // what is wrong is said already
    }
  }

  /** Show how the error fell, down to the noise once a diagnosis knows it. */
  #showFall() {
    const { texts, parts, results, actions } = this;
    if (!results?.fall) return;
    const noise = this.diagnosis?.diagnosis?.noise;
    const floor = noise ? { label: texts.noiseFloor, share: Math.min(1, noise.value / results.fall.largest), cells: [noise.written] } : null;
    fill(parts.fall, panels.fall(texts, { fall: { ...results.fall, floor } }, actions));
  }

  showDiagnosis() {
    const { texts, parts, job, diagnosis } = this;
    const found = diagnosis?.diagnosis;
    this.#showFall();
    fill(parts.verdict, panels.verdict(texts, job, diagnosis, this.number, this.actions));
    fill(parts.candidates, found && found.verdict !== "adequate" && panels.candidates(texts, found, this.actions));
    fill(parts.found, found && found.sections.map((each) => section(each, each.key === "plan" && !found.isTied)));
    fill(parts.hidden, found && panels.hidden(texts, found));
    document.body.dataset.state = found ? found.verdict : "working";
  }

  #showTables() {
    const { texts, parts, job, tables } = this;
    fill(parts.tables, crossTables(texts, job, tables && { ...tables, current: tables.stamp === this.stamp }, this.wanted.tables, this.actions));
  }

  /** Have a forecast of tables across axes, have them written, or circles held against them. */
  async #tables(wanted) {
    this.wanted.tables = wanted;
    try {
      this.tables = await post("/api/tables", wanted);
      this.#showTables();
    } catch (error) {
      this.tell(error);
    }
  }

  showMade() {
    this.#showTables();
    const { texts, parts, job, actions } = this;
    fill(parts.stairs, panels.stairs(texts, job, this.made.get("build"), this.number, actions));
    const made = this.made.get("certificate");
    fill(parts.certificate, panels.certificate(texts, job, made && { ...made, current: made.stamp === this.stamp }, this.wanted, this.number, actions));
  }

  /** Show the test before and after a step that is pointed at; null for none. */
  async #preview(step, name) {
    this.previewed = step;
    const { previews, test } = this;
    if (step === null) {
      this.graphs?.compare(null);
      return;
    }
    try {
      const found = await remembered(previews, `${test} ${step}`, "/api/step", { of: step, test });
      if (this.previewed === step && this.previews === previews && this.test === test) this.graphs.compare(found, name);
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Silence)) throw error;
    }
  }
}

/** Return the words of the graphs of a test: those of a circle where it is one. */
function textsOf(texts, { kind }) {
  if (kind !== "circle") return texts;
  const own = Object.entries(texts).filter(([name]) => name.endsWith(OF_CIRCLE));
  return { ...texts, ...Object.fromEntries(own.map(([name, text]) => [name.slice(0, -OF_CIRCLE.length), text])) };
}
