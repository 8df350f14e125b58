// The page of the workbench: shows the job as it stands in its file, and sends clicks to it.

import { showCapture } from "./capture.js";
import { Comparison } from "./comparison.js";
import { fill, h } from "./dom.js";
import { showEffect } from "./effect.js";
import { showFolder } from "./folder.js";
import { Graphs } from "./graphs.js";
import { Loop } from "./loop.js";
import { MachinePage } from "./machine.js";
import * as panels from "./panels.js";
import { ROOT, Refusal, Silence, get, remembered } from "./server.js";

const PLACES = { certificate: "certificate", table: "compensation", confirmation: "compensation", experiment: "experiment", build: "stairs" };
const NESTED = new Set(["lacking", "certificate"]);

class Page extends Loop {
  constructor(texts) {
    super(texts, PLACES);
    Object.assign(this.actions, {
      fix: (effect, parameter, value) => this.change({ action: "fix", effect, parameter, value }),
      free: (effect, parameter) => this.change({ action: "free", effect, parameter }),
      include: (listed) => this.change({ action: "include", listed }),
      state: (stated) => this.change({ action: "state", stated }),
      preview: (step, name) => this.#preview(step, name),
      wave: (of) => this.#wave(of),
      build: () => this.make("build", {}),
      noTable: () => this.change({ action: "state", stated: { "axis.compensation_table": "none" } }),
    });
    this.graphs = new Graphs(texts, this.number, (readings, reason) => this.change({ action: "exclude", readings, reason }), (range) => this.#closer(range));
    this.comparison = new Comparison(texts, this.number, (curves) => this.graphs.overlay(curves));
    this.parts = Object.fromEntries(["verdict", "fall", "stairs", "faults", "failures", "candidates", "experiment", "hidden", "compensation", "lacking", "certificate", "effects", "standards", "excluded", "steps", "preview"]
      .map((name) => [name, h("section", { class: NESTED.has(name) ? false : "panel", id: `part-${name}` })]));
    const { verdict, fall, stairs, faults, failures, candidates, experiment, hidden, compensation, lacking, certificate, effects, standards, excluded, steps, preview } = this.parts;
    document.body.replaceChildren(this.header, this.notice, this.spoken, h("main", {},
      h("div", { class: "bench" }, h("div", { class: "always" }, verdict, fall), standards, h("div", { class: "seen" }, preview, this.graphs.element, this.comparison.element, effects),
      h("div", { class: "findings" }, stairs, faults, failures, candidates, experiment, hidden, compensation, h("div", { class: "panel", id: "part-document" }, certificate, lacking), excluded, steps))));
  }

  show(job) {
    this.job = job;
    this.stamp = job.stamp;
    this.diagnosis = null;
    this.previews = new Map();
    this.waves = new Map();
    this.previewed = null;
    this.graphs.show(job.graphs);
    this.graphs.compare(null);
    const { texts, parts } = this;
    fill(this.header, ...this.heading(job));
    fill(parts.effects, panels.effects(texts, job, this.actions));
    fill(parts.excluded, panels.excluded(texts, job, this.actions));
    fill(parts.steps, panels.steps(texts, job));
    this.showMade();
    this.showDiagnosis();
    this.#results(job.stamp);
    this.#compare(job.stamp);
    this.diagnose(job.stamp);
  }

  /** Show what takes longer than the graphs. */
  async #results(stamp) {
    try {
      const results = await get("/api/results");
      if (this.stamp !== stamp) return;
      fill(this.parts.fall, panels.fall(this.texts, results, this.actions));
      fill(this.parts.standards, panels.standards(this.texts, results));
      fill(this.parts.lacking, panels.lacking(this.texts, results.lacking, this.actions));
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Silence)) throw error; // what is wrong is said already
    }
  }

  /** Show other tests again where their files have changed. */
  async beside(stamp, tests) {
    if (this.tests !== undefined && tests !== this.tests) await this.#compare(stamp);
  }

  /** Return the model's curves on a part of the axis; null where it is another model now. */
  async #closer([low, high]) {
    try {
      const near = await get("/api/closer", { low, high });
      return near.stamp === this.stamp ? near : null;
    } catch (error) {
      if (error instanceof Refusal || error instanceof Silence) return null; // what is wrong is said already
      throw error;
    }
  }

  /** Show other tests of the axis beside that of the job. */
  async #compare(stamp) {
    try {
      const found = await get("/api/tests");
      if (this.stamp !== stamp) return;
      this.tests = found.stamp;
      this.comparison.show(found, this.job.graphs);
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Silence)) throw error; // what is wrong is said already
    }
  }

  showDiagnosis() {
    const { texts, parts, job, diagnosis } = this;
    fill(parts.verdict, panels.verdict(texts, job, diagnosis, this.number, this.actions));
    const found = diagnosis?.diagnosis;
    fill(parts.faults, found ? panels.faults(texts, found, (axis, places) => this.graphs.point(axis, places)) : []);
    if (found?.faults.length) this.graphs.ring(found.faults.flatMap((each) => each.readings));
    fill(parts.failures, found ? panels.failures(texts, found, (axis, places) => this.graphs.point(axis, places)) : []);
    fill(parts.candidates, found ? panels.candidates(texts, found, this.actions) : []);
    this.#showExperiment();
    fill(parts.hidden, found ? panels.hidden(texts, found) : []);
    document.body.dataset.state = found ? found.verdict : "working";
  }

  #showExperiment() {
    const made = this.made.get("experiment");
    const current = made && { ...made, current: made.stamp === this.stamp };
    fill(this.parts.experiment, panels.experiment(this.texts, this.diagnosis?.diagnosis?.experiment, current, this.number, this.actions));
  }

  showMade() {
    const { texts, parts, job, actions } = this;
    this.#showExperiment();
    fill(parts.stairs, panels.stairs(texts, job, this.made.get("build"), this.number, actions));
    const made = Object.fromEntries([...this.made].map(([name, each]) => [name, { ...each, current: each.stamp === this.stamp }]));
    fill(parts.certificate, panels.certificate(texts, job, made.certificate, this.wanted, this.number, actions));
    fill(parts.compensation, panels.compensation(texts, job, made, this.wanted, this.number, actions));
  }

  /** Return what draws an effect on one of its periods; null where it has none, or is not to be had. */
  async #wave(of) {
    try {
      return (await remembered(this.waves, of, "/api/folded", { of })).wave;
    } catch (error) {
      if (error instanceof Refusal || error instanceof Silence) return null;
      throw error;
    }
  }

  /** Show before and after a step that is pointed at, as soon as it is known and if it still is; null for none. */
  async #preview(step, name) {
    this.previewed = step;
    const { previews } = this;
    if (step === null) {
      this.graphs.compare(null);
      return;
    }
    try {
      const found = await remembered(previews, step, "/api/step", { of: step });
      if (this.previewed === step && this.previews === previews) this.graphs.compare(found, name);
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Silence)) throw error;
    }
  }
}

const texts = await get("/api/texts");
const effect = location.pathname.slice(ROOT.length).match(/^\/effects\/(.+)$/)?.[1];
if (texts.folder) await showFolder(texts);
else if (effect) await showEffect(texts, effect);
else if (texts.machine) await new MachinePage(texts).begin();
else await begin();

/** Show the capture of a job whose readings are still to come, or else its workbench. */
async function begin() {
  const capture = await get("/api/capture").catch(() => ({ isCaptured: false })); // what is wrong with the job is said there
  if (capture.isCaptured && !capture.isOver) await showCapture(texts, capture);
  else await new Page(texts).begin();
}
