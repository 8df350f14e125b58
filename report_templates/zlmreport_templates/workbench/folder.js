// The jobs of a folder: the worst first, each a link to its workbench.

import { fill, h } from "./dom.js";
import { languageChoice } from "./languages.js";
import { Refusal, Silence, get } from "./server.js";

const SIGNS = { fails: "✕", "not-met": "✕", overdue: "!", undecided: "?", soon: "◷", earlier: "·", fine: "✓", waits: "…" };
const EARLIER = "earlier";
const WAITS = 500;
const LOOK = 3000;

/** Show the list, and go on looking whether it has changed. */
export async function showFolder(texts) {
  const counts = h("ul", { class: "counts", role: "status" });
  const list = h("section", { class: "panel", "aria-labelledby": "jobs" });
  document.body.replaceChildren(
    h("header", {}, h("h1", {}, texts.folder), h("code"), languageChoice(texts)),
    h("main", {}, counts, list));
  let before = "";
  for (;;) {
    let waits = LOOK;
    try {
      const { jobs } = await get("/api/folder");
      if (jobs.some((each) => each.state === "waits")) waits = WAITS;
      const now = JSON.stringify(jobs);
      if (now !== before) {
        fill(counts, counted(jobs));
        fill(list, h("h2", { id: "jobs" }, texts.jobs), table(texts, jobs.filter(({ state }) => state !== EARLIER)), earlier(texts, jobs.filter(({ state }) => state === EARLIER)));
      }
      before = now;
    } catch (error) {
      if (!(error instanceof Refusal || error instanceof Silence)) throw error;
      before = "";
      fill(list, h("ul", { class: "problems", role: "alert" }, (error.problems ?? [texts.gone]).map((each) => h("li", {}, each))));
    }
    await new Promise((resolve) => { setTimeout(resolve, waits); });
  }
}

/** A day with what it is the day of, which a small screen has no heading for. */
function dated(name, day) {
  return h("td", { class: "date" }, day && [h("span", { class: "of-day" }, `${name} `), day]);
}

/** Earlier tests of the axes, folded away: nobody has to do anything about them. */
function earlier(texts, jobs) {
  return jobs.length > 0 && h("details", {}, h("summary", {}, `${texts.earlier} (${jobs.length})`), table(texts, jobs));
}

function counted(jobs) {
  const states = [...new Set(jobs.map((each) => each.state))];
  return states.map((state) => {
    const those = jobs.filter((each) => each.state === state);
    return h("li", { class: state }, h("strong", {}, those.length), " ", those[0].words);
  });
}

function table(texts, jobs) {
  const heads = [texts.jobState, texts.job, texts.axis, texts.measuredOn, texts.dueOn];
  return h("table", { class: "jobs" },
    h("thead", {}, h("tr", {}, heads.map((name) => h("th", { scope: "col" }, name)))),
    h("tbody", {}, jobs.map((each) => h("tr", { class: each.state },
      h("td", { class: "state" }, h("span", { "aria-hidden": "true" }, `${SIGNS[each.state]} `), each.words),
      h("th", { scope: "row" }, each.closed ? each.name : h("a", { href: `/jobs/${each.key}/${location.search}`, "data-key": each.key }, each.name),
        each.number && h("span", { class: "quiet" }, ` ${each.number}`),
        each.closed && h("p", { class: "quiet" }, each.closed),
        each.problems.length > 0 && h("ul", { class: "problems" }, each.problems.map((one) => h("li", {}, one)))),
      h("td", {}, each.axis, each.machine && h("span", { class: "quiet" }, ` ${each.machine}`)),
      dated(texts.measuredOn, each.measured), dated(texts.dueOn, each.due)))));
}
