// The page of a capture: what to do now, what the instrument shows, and what was taken.

import { fill, h, said } from "./dom.js";
import { ROOT, Refusal, Silence, get, post } from "./server.js";

const LOOK = 400;
const REST = 2000;
const STATES = { taken: "captureIsTaken", next: "captureIsNext", open: "captureIsOpen", skipped: "captureIsSkipped", missed: "captureIsMissed" };

/** Show the capture of a job until its readings are all there; `found` is the first answer of the server. */
export async function showCapture(texts, found) {
  const page = new CapturePage(texts);
  page.show(found);
  await page.follow();
}

class CapturePage {
  constructor(texts) {
    this.texts = texts;
    this.header = h("header");
    this.notice = h("div", { class: "notice", role: "alert", hidden: true });
    this.now = h("section", { class: "panel capture-now", "aria-live": "off" });
    this.asked = h("section", { class: "panel capture-asked", role: "alert", hidden: true });
    this.orders = h("section", { class: "panel capture-orders" });
    this.visits = h("section", { class: "panel", "aria-label": texts.captureVisit });
    this.events = h("section", { class: "panel" });
    this.before = {};
    this.refused = [];
    document.body.replaceChildren(this.header, this.notice, h("main", { class: "capture" },
      h("div", {}, this.now, this.asked, this.orders, this.events), this.visits));
  }

  /** Go on looking: often while it runs. */
  async follow() {
    for (;;) {
      await new Promise((done) => setTimeout(done, this.found.runs ? LOOK : REST));
      try {
        const found = await get("/api/capture");
        if (!found.isCaptured || (found.isOver && !this.found.isOver && !this.found.runs)) location.reload();
        this.show(found);
      } catch (error) {
        this.#tell(error);
      }
    }
  }

  show(found) {
    const { texts } = this;
    this.found = found;
    document.body.dataset.state = found.runs ? "captures" : found.isOver ? "over" : "rests";
    this.#fillIfNew("header", this.header, [found.number], () => [
      h("h1", {}, found.number, " ", h("span", {}, found.subject)),
      ROOT && h("a", { href: `/${location.search}` }, texts.allJobs),
      h("code", {}, found.file)]);
    this.#fillIfNew("now", this.now, [found.moment, found.steps, found.taken, found.minutes, found.runs, found.isOver], () => this.#now(found));
    this.asked.hidden = found.asked === null;
    this.#fillIfNew("asked", this.asked, found.asked, () => this.#asked(found.asked));
    this.#fillIfNew("orders", this.orders, [found.runs, found.isOver, found.hasBegun, found.next, found.taken], () => this.#orders(found));
    this.#fillIfNew("visits", this.visits, [found.visits, found.runs], () => this.#visits(found));
    this.#fillIfNew("events", this.events, found.lines, () => found.lines.length > 0 && [
      h("h2", {}, texts.captureEvents), h("ol", { class: "capture-lines", reversed: true }, found.lines.toReversed().map(({ name, text }) => h("li", {}, name && h("strong", {}, name), name && " ", text)))]);
    this.#say([...this.refused, ...found.problems]);
  }

  /** Fill an element only where what it shows has changed: what somebody types into or points at stays. */
  #fillIfNew(name, element, shown, made) {
    const now = JSON.stringify(shown);
    if (this.before[name] === now) return;
    this.before[name] = now;
    fill(element, made() || []);
  }

  #now(found) {
    const { texts } = this, { moment } = found;
    return [
      h("h2", {}, texts.capture),
      found.isOver
        ? [h("p", {}, texts.captureOver), h("p", {}, h("a", { class: "button", href: location.href }, texts.captureOpen))]
        : h(found.steps.length > 1 ? "ol" : "ul", { class: "capture-steps" }, found.steps.map((each) => h("li", {}, each))),
      found.runs && (moment === null ? h("p", { class: "capture-position" }, texts.captureWaits) : [
        h("p", { class: "capture-position number" }, moment.message || moment.position || texts.captureNoDatum),
        h("p", { class: "number" }, moment.deviation ?? (moment.toGo && said(texts.captureToGo, { way: moment.toGo })) ?? "", " ", moment.range ? said(texts.captureRange, { range: moment.range }) : ""),
        h("label", { class: "capture-still" }, texts.captureStill, h("progress", { max: 1, value: moment.still }))]),
      h("label", { class: "capture-still" }, said(texts.captureTaken, { taken: found.taken, planned: found.visits.length }), h("progress", { max: found.visits.length, value: found.taken })),
      !found.isOver && found.minutes > 0 && h("p", {}, said(texts.captureMinutes, { minutes: found.minutes })),
    ];
  }

  #asked(asked) {
    if (asked === null) return [];
    const { texts } = this;
    return [
      h("p", {}, asked.message),
      asked.steps.length > 0 && h("ol", {}, asked.steps.map((each) => h("li", {}, each))),
      h("p", { class: "aside" }, asked.choices.length > 0
        ? asked.choices.map(({ label, answer }) => this.#button(label, "order", answer))
        : this.#button(texts.captureDone, "order", "")),
    ];
  }

  #orders(found) {
    const { texts } = this;
    if (!found.runs) {
      return [
        h("p", {}, said(texts.captureOf, { journal: found.journal })),
        h("p", { class: "aside" },
          !found.isOver && this.#button(found.hasBegun ? texts.captureGoOn : texts.captureBegin, "begin", "", "capture-begin"),
          found.hasBegun && !found.isOver && this.#button(texts.captureClose, "close", "", "quiet", texts.captureCloseHelp)),
      ];
    }
    const comment = h("input", { maxlength: 200, "aria-label": texts.captureComment, "data-key": "comment", placeholder: texts.captureComment });
    const note = () => { if (comment.value.trim()) { this.#do("order", `c ${comment.value.trim()}`); comment.value = ""; } };
    return [
      h("p", { class: "aside" },
        found.next !== null && this.#button(said(texts.captureSkip, { number: found.next }), "order", "s"),
        found.taken > 0 && this.#button(texts.captureBack, "order", "b"),
        this.#button(texts.captureStop, "stop", "", "quiet")),
      h("form", { class: "aside", submit: (event) => { event.preventDefault(); note(); } }, comment, h("button", { type: "submit" }, texts.captureNote)),
    ];
  }

  #visits(found) {
    const { texts } = this;
    const number = { class: "number" };
    const heads = [[texts.captureVisit, number], [texts.captureRun, {}], [texts.captureTarget, number], [texts.captureDeviation, number], [texts.captureSpread, number], [texts.captureState, {}]];
    const seen = new Set();
    return h("table", { class: "capture-visits" },
      h("thead", {}, h("tr", {}, heads.map(([head, kind]) => h("th", { scope: "col", ...kind }, head)), h("td"))),
      h("tbody", {}, found.visits.map((each) => {
        const is_first = !seen.has(each.run);
        seen.add(each.run);
        return h("tr", { class: each.state, "aria-current": each.state === "next" && "step" },
          h("td", { class: "number" }, each.number),
          h("td", {}, `${each.run} ${each.arrow}`),
          h("td", { class: "number" }, each.target),
          h("td", { class: "number", "data-head": texts.captureDeviation }, each.deviation),
          h("td", { class: "number", "data-head": texts.captureSpread }, each.range),
          h("td", {}, texts[STATES[each.state]]),
          h("td", {}, h("div", { class: "capture-again" }, (each.state === "taken" || each.state === "skipped" || each.state === "missed") && [
            this.#button(texts.captureRetake, found.runs ? "order" : "retake", found.runs ? `r ${each.number}` : `${each.number}`, "quiet", said(texts.captureRetakeOf, each)),
            is_first && this.#button(said(texts.captureRunAgain, each), found.runs ? "order" : "retake", found.runs ? `r run ${each.run}` : `run ${each.run}`, "quiet")])));
      })));
  }

  #button(label, step, text, kind = "", title = null) {
    return h("button", { type: "button", class: kind || false, title, "data-key": `${step} ${text}`, click: () => this.#do(step, text) }, label);
  }

  async #do(step, text) {
    this.refused = []; // what was wrong with a click stands until the next
    try {
      this.show(await post("/api/capture", { step, text }));
    } catch (error) {
      if (error instanceof Refusal) this.refused = error.problems;
      this.#tell(error);
    }
  }

  #tell(error) {
    if (error instanceof Silence) this.#say([this.texts.gone]);
    else if (error instanceof Refusal) this.#say(error.problems);
    else throw error;
  }

  #say(sentences) {
    this.notice.hidden = sentences.length === 0;
    this.#fillIfNew("notice", this.notice, sentences, () => sentences.map((each) => h("p", {}, each)));
  }
}
