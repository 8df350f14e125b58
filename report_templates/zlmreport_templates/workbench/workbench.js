// The page of the workbench: shows the job as it stands in its file, and sends clicks to it.

import { showCapture } from "./capture.js";
import { Comparison } from "./comparison.js";
import { fill, h, said } from "./dom.js";
import { showEffect } from "./effect.js";
import { showFolder } from "./folder.js";
import { Graphs } from "./graphs.js";
import { languageChoice } from "./languages.js";
import { written } from "./number.js";
import * as panels from "./panels.js";
import { ROOT, Refusal, Silence, get, post } from "./server.js";

const LOOK = 1500;
const ASK = 250;
const PLACES = { certificate: "certificate", table: "compensation", confirmation: "compensation", experiment: "experiment", build: "stairs" };
const NESTED = new Set(["lacking", "certificate"]);

class Page {
  constructor(texts) {
    this.texts = texts;
    this.number = written;
    this.made = new Map();
    this.wanted = {};
    this.actions = {
      add: (effect) => this.#change({ action: "add", effect }),
      remove: (effect) => this.#change({ action: "remove", effect }),
      fix: (effect, parameter, value) => this.#change({ action: "fix", effect, parameter, value }),
      free: (effect, parameter) => this.#change({ action: "free", effect, parameter }),
      include: (listed) => this.#change({ action: "include", listed }),
      state: (stated) => this.#change({ action: "state", stated }),
      stop: () => post("/api/diagnosis/stop", {}).catch((error) => this.#tell(error)),
      diagnose: () => { this.diagnosis = null; this.#showDiagnosis(); this.#diagnose(this.stamp); },
      preview: (step, name) => this.#preview(step, name),
      number: this.number,
      wave: (of) => this.#wave(of),
      build: () => this.#make("build", {}),
      climb: (steps) => this.#climb(steps),
      undo: () => this.#change({ action: "undo" }),
      stopMaking: (name) => post(`/api/made/${name}/stop`, {}).catch((error) => this.#tell(error)),
      lookAtPages: () => this.#lookAtPages(),
      make: (name, wanted) => { this.wanted[name] = wanted; this.#make(name, wanted); },
      noTable: () => this.#change({ action: "state", stated: { "axis.compensation_table": "none" } }),
    };
    this.graphs = new Graphs(texts, this.number, (readings, reason) => this.#change({ action: "exclude", readings, reason }), (range) => this.#closer(range));
    this.comparison = new Comparison(texts, this.number, (curves) => this.graphs.overlay(curves));
    this.notice = h("div", { class: "notice", role: "alert", hidden: true });
    this.header = h("header", {}, this.#all(), h("p", { role: "status" }, texts.working));
    this.parts = Object.fromEntries(["verdict", "fall", "stairs", "faults", "failures", "candidates", "experiment", "hidden", "compensation", "lacking", "certificate", "effects", "standards", "excluded", "steps", "preview"]
      .map((name) => [name, h("section", { class: NESTED.has(name) ? false : "panel", id: `part-${name}` })]));
    const { verdict, fall, stairs, faults, failures, candidates, experiment, hidden, compensation, lacking, certificate, effects, standards, excluded, steps, preview } = this.parts;
    document.body.replaceChildren(this.header, this.notice, h("main", {},
      h("div", { class: "bench" }, h("div", { class: "always" }, verdict, fall), standards, h("div", { class: "seen" }, preview, this.graphs.element, this.comparison.element, effects),
      h("div", { class: "findings" }, stairs, faults, failures, candidates, experiment, hidden, compensation, h("div", { class: "panel", id: "part-document" }, certificate, lacking), excluded, steps))));
  }

  /** Show the job as it is, and go on looking whether it still is. */
  async begin() {
    await this.#load();
    setInterval(() => this.#look(), LOOK);
    addEventListener("keydown", (event) => this.#typed(event));
  }

  async #load() {
    try {
      this.#show(await get("/api/job"));
      return true;
    } catch (error) {
      if (!this.job) fill(this.header, this.#all());
      this.#tell(error, this.texts.broken);
      return false;
    }
  }

  #show(job) {
    this.job = job;
    this.stamp = job.stamp;
    this.diagnosis = null;
    this.previews = new Map();
    this.waves = new Map();
    this.previewed = null;
    this.graphs.show(job.graphs);
    this.graphs.compare(null);
    const { texts, parts } = this;
    fill(this.header, ...this.#heading(job));
    fill(parts.effects, panels.effects(texts, job, this.actions));
    fill(parts.excluded, panels.excluded(texts, job, this.actions));
    fill(parts.steps, panels.steps(texts, job));
    this.#showMade();
    this.#showDiagnosis();
    this.#results(job.stamp);
    this.#compare(job.stamp);
    this.#diagnose(job.stamp);
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

  /** Return the way back to the folder, where the job was opened from one. */
  #all() {
    return ROOT && h("a", { href: `/${location.search}`, "data-key": "all-jobs" }, this.texts.allJobs);
  }

  #heading(job) {
    const { texts } = this;
    return [
      h("h1", {}, job.number, h("span", {}, job.subject)),
      this.#all(),
      h("code", {}, job.file),
      h("span", { class: "busy", "aria-hidden": "true" }, texts.working),
      [["undo", texts.undo, texts.undoOf], ["redo", texts.redo, texts.redoOf]].map(([action, name, of]) =>
        h("button", { type: "button", "data-key": action, disabled: job[action] === null, click: () => this.#change({ action }) },
          job[action] === null ? name : said(of, { step: job[action] }))),
      languageChoice(texts),
    ];
  }

  #showDiagnosis() {
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

  #showMade() {
    const { texts, parts, job, actions } = this;
    this.#showExperiment();
    fill(parts.stairs, panels.stairs(texts, job, this.made.get("build"), this.number, actions));
    const made = Object.fromEntries([...this.made].map(([name, each]) => [name, { ...each, current: each.stamp === this.stamp }]));
    fill(parts.certificate, panels.certificate(texts, job, made.certificate, this.wanted, this.number, actions));
    fill(parts.compensation, panels.compensation(texts, job, made, this.wanted, this.number, actions));
  }

  /** Return what draws an effect on one of its periods; null where it has none, or is not to be had. */
  async #wave(of) {
    const { waves } = this;
    if (!waves.has(of)) waves.set(of, get("/api/folded", { of }).then(({ wave }) => wave));
    try {
      return await waves.get(of);
    } catch (error) {
      if (error instanceof Refusal || error instanceof Silence) return null;
      throw error;
    }
  }

  /** Have something made, and show how far it is. */
  async #make(name, wanted) {
    try {
      let found = await post(`/api/made/${name}`, wanted);
      while (found.state === "making") {
        this.#keep(name, found);
        await new Promise((resolve) => { setTimeout(resolve, ASK); });
        found = await get(`/api/made/${name}`);
      }
      this.#keep(name, found);
    } catch (error) {
      this.#tell(error);
    }
  }

  #keep(name, found) {
    const before = this.made.get(name)?.state;
    this.made.set(name, found);
    const waits = this.parts[PLACES[name]].querySelector(".progress span");
    if (before === "making" && found.state === "making" && waits) waits.textContent = said(this.texts.seconds, { seconds: this.number(found.seconds) });
    else this.#showMade();
    if (name === "certificate" && before === "making" && found.state === "made") this.#lookAtPages();
  }

  /** Show the pages of the certificate where they are wide enough to be read, and bring them into view. */
  #lookAtPages() {
    const { parts, texts } = this;
    const made = this.made.get("certificate");
    fill(parts.preview, Object.keys(made.pages).length > 0 && panels.preview(texts, made, () => {
      fill(parts.preview);
      parts.certificate.querySelector("[data-key=look-at-pages]")?.focus();
    }));
    parts.preview.scrollIntoView({ block: "start" });
    parts.preview.querySelector("[data-key=page-after]")?.focus({ preventScroll: true });
  }

  async #diagnose(stamp) {
    while (this.stamp === stamp) {
      try {
        this.diagnosis = await get("/api/diagnosis");
      } catch (error) {
        if (error instanceof Silence) return;
        this.diagnosis = { problems: error.problems };
      }
      if (this.stamp !== stamp) return;
      const waits = this.parts.verdict.querySelector(".progress span");
      if (this.diagnosis.seconds !== undefined && waits) waits.textContent = said(this.texts.underWay, { seconds: this.number(this.diagnosis.seconds), share: this.number(Math.round(100 * this.diagnosis.share)) });
      else this.#showDiagnosis();
      if (this.diagnosis.seconds === undefined) return;
      await new Promise((resolve) => { setTimeout(resolve, ASK); });
    }
  }

  /** Whether the files of the job have changed, or the program has ended. */
  async #look() {
    if (this.working) return;
    try {
      const { stamp, tests } = await get("/api/stamp");
      if (this.silent) this.#hush();
      if (this.working) return;
      if (stamp === this.stamp) {
        if (this.tests !== undefined && tests !== this.tests) await this.#compare(stamp);
        return;
      }
      this.stamp = stamp;
      if (await this.#load()) this.#say(this.texts.outside);
    } catch (error) {
      this.#tell(error);
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
    if (!previews.has(step)) previews.set(step, get("/api/step", { of: step }));
    try {
      const found = await previews.get(step);
      if (this.previewed === step && this.previews === previews) this.graphs.compare(found, name);
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Silence)) throw error;
    }
  }

  /** Undo and redo by the keys that people know, but not while they write. */
  #typed(event) {
    if (!(event.ctrlKey || event.metaKey) || event.target.closest("input, select")) return;
    const key = event.key.toLowerCase();
    let action = null;
    if (key === "z") action = event.shiftKey ? "redo" : "undo";
    else if (key === "y") action = "redo";
    if (action === null) return;
    event.preventDefault();
    if (this.job?.[action]) this.#change({ action });
  }

  /** Take steps of a staircase, each a change of its own, as far as they are not refused. */
  async #climb(steps) {
    for (const { removed, effect, argument } of steps) {
      if (!(await this.#change(removed ? { action: "remove", effect } : { action: "add", effect: argument }))) return;
    }
  }

  /** Do one thing after the other: a click while another is under way is not lost. */
  #change(wanted) {
    this.queue = (this.queue ?? Promise.resolve()).then(() => this.#changeNow(wanted));
    return this.queue;
  }

  async #changeNow(wanted) {
    this.working = true;
    document.body.setAttribute("aria-busy", "true");
    try {
      const job = await post("/api/change", { based_on: this.job.digest, ...wanted });
      this.#hush();
      this.#show(job);
      return true;
    } catch (error) {
      if (error instanceof Refusal && error.status === 409) await this.#load();
      this.#tell(error);
      return false;
    } finally {
      this.working = false;
      document.body.removeAttribute("aria-busy");
    }
  }

  #tell(error, ...first) {
    if (error instanceof Silence) {
      this.silent = true;
      this.#say(this.texts.gone);
    } else if (error instanceof Refusal) {
      if (error.stamp) this.stamp = error.stamp;
      this.#say(...first, ...error.problems);
    } else throw error;
  }

  #say(...sentences) {
    fill(this.notice, sentences.map((each) => h("p", {}, each)),
      h("button", { type: "button", class: "quiet", click: () => this.#hush() }, this.texts.close));
    this.notice.hidden = false;
  }

  #hush() {
    this.silent = false;
    this.notice.hidden = true;
    fill(this.notice);
  }
}

const texts = await get("/api/texts");
const effect = location.pathname.slice(ROOT.length).match(/^\/effects\/(.+)$/)?.[1];
if (texts.folder) await showFolder(texts);
else if (effect) await showEffect(texts, effect);
else await begin();

/** Show the capture of a job whose readings are still to come, or else its workbench. */
async function begin() {
  const capture = await get("/api/capture").catch(() => ({ isCaptured: false })); // what is wrong with the job is said there
  if (capture.isCaptured && !capture.isOver) await showCapture(texts, capture);
  else await new Page(texts).begin();
}
