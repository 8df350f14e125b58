// What the pages of a job and of a machine have alike: clicks, the keys of undo, what is wrong, what is under way.

import { fill, h, said } from "./dom.js";
import { languageChoice } from "./languages.js";
import { written } from "./number.js";
import * as panels from "./panels.js";
import { ROOT, Refusal, Silence, get, post } from "./server.js";

const LOOK = 1500;
const ASK = 250;

/** A page that shows a file as it stands; who extends it has `show`, `showDiagnosis`, `showMade` and `parts`. */
export class Loop {
  /** `places` says in which part of the page it is told how far something is that is being made. */
  constructor(texts, places) {
    this.texts = texts;
    this.places = places;
    this.number = written;
    this.made = new Map();
    this.wanted = {};
    this.actions = {
      add: (effect) => this.change({ action: "add", effect }),
      remove: (effect) => this.change({ action: "remove", effect }),
      undo: () => this.change({ action: "undo" }),
      climb: (steps) => this.climb(steps),
      stop: () => post("/api/diagnosis/stop", {}).catch((error) => this.tell(error)),
      diagnose: () => { this.diagnosis = null; this.showDiagnosis(); this.diagnose(this.stamp); },
      make: (name, wanted) => { this.wanted[name] = wanted; this.make(name, wanted); },
      stopMaking: (name) => post(`/api/made/${name}/stop`, {}).catch((error) => this.tell(error)),
      lookAtPages: () => this.lookAtPages(),
      number: this.number,
    };
    this.notice = h("div", { class: "notice", role: "alert", hidden: true });
    this.spoken = h("p", { class: "unseen", role: "status" });
    this.header = h("header", {}, this.all(), h("p", { role: "status" }, texts.working));
  }

  /** Show the job as it is, and go on looking whether it still is. */
  async begin() {
    await this.load();
    setInterval(() => this.look(), LOOK);
    addEventListener("keydown", (event) => this.typed(event));
  }

  async load() {
    try {
      this.show(await get("/api/job"));
      return true;
    } catch (error) {
      if (!this.job) fill(this.header, this.all());
      this.tell(error, this.texts.broken);
      return false;
    }
  }

  /** Return the way back to the folder, where the job was opened from one. */
  all() {
    return ROOT && h("a", { href: `/${location.search}`, "data-key": "all-jobs" }, this.texts.allJobs);
  }

  heading(job) {
    const { texts } = this;
    return [
      h("h1", {}, job.number, " ", h("span", {}, job.subject)),
      this.all(),
      h("code", {}, job.file),
      h("span", { class: "busy", "aria-hidden": "true" }, texts.working),
      [["undo", texts.undo, texts.undoOf], ["redo", texts.redo, texts.redoOf]].map(([action, name, of]) =>
        h("button", { type: "button", "data-key": action, disabled: job[action] === null, click: () => this.change({ action }) },
          job[action] === null ? name : said(of, { step: job[action] }))),
      languageChoice(texts),
    ];
  }

  /** Have something made, and show how far it is. */
  async make(name, wanted) {
    try {
      let found = await post(`/api/made/${name}`, wanted);
      while (found.state === "making") {
        this.keep(name, found);
        await new Promise((resolve) => { setTimeout(resolve, ASK); });
        found = await get(`/api/made/${name}`);
      }
      this.keep(name, found);
    } catch (error) {
      this.tell(error);
    }
  }

  keep(name, found) {
    const before = this.made.get(name)?.state;
    this.made.set(name, found);
    const waits = this.parts[this.places[name]].querySelector(".progress span");
    if (before === "making" && found.state === "making" && waits) waits.textContent = said(this.texts.seconds, { seconds: this.number(found.seconds) });
    else this.showMade();
    if (name === "certificate" && before === "making" && found.state === "made") this.lookAtPages();
  }

  /** Show the pages of the certificate where they are wide enough to be read, and bring them into view. */
  lookAtPages() {
    const { parts, texts } = this;
    const made = this.made.get("certificate");
    fill(parts.preview, Object.keys(made.pages).length > 0 && panels.preview(texts, made, () => {
      fill(parts.preview);
      parts.certificate.querySelector("[data-key=look-at-pages]")?.focus();
    }));
    parts.preview.scrollIntoView({ block: "start" });
    parts.preview.querySelector("[data-key=page-after]")?.focus({ preventScroll: true });
  }

  /** Whether the files of the job have changed, or the program has ended. */
  async look() {
    if (this.working) return;
    try {
      const { stamp, tests } = await get("/api/stamp");
      if (this.silent) this.hush();
      if (this.working) return;
      if (stamp === this.stamp) {
        await this.beside(stamp, tests);
        return;
      }
      this.stamp = stamp;
      if (await this.load()) this.say(this.texts.outside);
    } catch (error) {
      this.tell(error);
    }
  }

  /** Show what stands beside the file again, if it has changed: nothing does, unless a page says so. */
  async beside() {}

  async diagnose(stamp) {
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
      else this.showDiagnosis();
      if (this.diagnosis.seconds === undefined) {
        this.spoken.textContent = this.diagnosis.diagnosis?.statement ?? "";
        return;
      }
      await new Promise((resolve) => { setTimeout(resolve, ASK); });
    }
  }

  /** Undo and redo by the keys that people know, but not while they write. */
  typed(event) {
    if (!(event.ctrlKey || event.metaKey) || event.target.closest("input, select")) return;
    const key = event.key.toLowerCase();
    let action = null;
    if (key === "z") action = event.shiftKey ? "redo" : "undo";
    else if (key === "y") action = "redo";
    if (action === null) return;
    event.preventDefault();
    if (this.job?.[action]) this.change({ action });
  }

  /** Take steps of a staircase, each a change of its own, as far as they are not refused. */
  async climb(steps) {
    for (const { removed, effect, argument } of steps) {
      if (!(await this.change(removed ? { action: "remove", effect } : { action: "add", effect: argument }))) return;
    }
  }

  /** Do one thing after the other: a click while another is under way is not lost. */
  change(wanted) {
    const done = (this.queue ?? Promise.resolve()).then(() => this.changeNow(wanted));
    this.queue = done.catch(() => false); // what nobody expected of one click does not keep the next from being done
    return done;
  }

  async changeNow(wanted) {
    this.working = true;
    document.body.setAttribute("aria-busy", "true");
    try {
      const job = await post("/api/change", { based_on: this.job.digest, ...wanted });
      this.hush();
      this.show(job);
      return true;
    } catch (error) {
      if (error instanceof Refusal && error.status === 409) await this.load();
      this.tell(error);
      return false;
    } finally {
      this.working = false;
      document.body.removeAttribute("aria-busy");
    }
  }

  tell(error, ...first) {
    if (error instanceof Silence) {
      this.silent = true;
      this.say(this.texts.gone);
    } else if (error instanceof Refusal) {
      if (error.stamp) this.stamp = error.stamp;
      this.say(...first, ...error.problems);
    } else throw error;
  }

  say(...sentences) {
    fill(this.notice, sentences.map((each) => h("p", {}, each)),
      h("button", { type: "button", class: "quiet", click: () => this.hush() }, this.texts.close));
    this.notice.hidden = false;
  }

  hush() {
    this.silent = false;
    this.notice.hidden = true;
    fill(this.notice);
  }
}
