// What stands beside and below the graphs. Each panel is a function from values to elements.

import { blocks } from "./blocks.js";
import { h, named, s, said, symbol } from "./dom.js";
import { explained } from "./help.js";
import { fixed, withUnit } from "./number.js";
import { ROOT } from "./server.js";
import { wave } from "./wave.js";

const SIGNS = { adequate: "✓", missing: "?", unexplained: "!" };
// Units as programs read them, where documents print a sign.
const PRINTED = { um: "µm", arcsec: "″" };
const LIKELY = 0.5;
const CONFIRMED = {
  held: "held", "wrong-sign": "wrongSign", half: "half", double: "double", "not-in-effect": "notInEffect", shifted: "shifted",
  "play-turned": "playTurned", "play-twice": "playTwice", "play-left": "playLeft", other: "otherTable",
};
const DOUBTS = new Set(["doubtful", "implausible"]);

/** The verdict in words, with the error of the model and what is asked for; while a diagnosis is under way, for how long. */
export function verdict(texts, job, diagnosis, number, actions) {
  const numbers = h("dl", { class: "numbers" }, job.error.map((each) => h("div", {}, h("dt", {}, explained(each.name, each.meaning)), h("dd", {}, each.value))));
  if (!diagnosis?.diagnosis) {
    const problems = diagnosis?.problems;
    let state = h("p", { class: "progress" }, h("progress", { "aria-label": texts.diagnosing }), ` ${texts.diagnosing} `,
      h("span", { "aria-hidden": "true" }, said(texts.underWay, { seconds: number(diagnosis?.seconds ?? 0), share: number(Math.round(100 * (diagnosis?.share ?? 0))) })), " ", button(texts.stop, texts.stop, "diagnosis", actions.stop));
    if (problems) state = h("ul", { class: "problems" }, problems.map((each) => h("li", {}, each)));
    if (diagnosis?.stopped) state = h("p", {}, `${texts.stopped} `, button(texts.diagnose, texts.diagnose, "diagnosis", actions.diagnose));
    return [h("h2", {}, texts.verdict), state, numbers];
  }
  const found = diagnosis.diagnosis;
  return [
    h("h2", {}, texts.verdict),
    found.next && h("p", { class: "next" }, found.next),
    h("p", { class: `verdict ${found.verdict}` }, h("span", { class: "sign", "aria-hidden": "true" }, SIGNS[found.verdict]), h("span", {}, found.statement)),
    found.findings && h("div", { class: "findings" }, blocks(found.findings)),
    numbers,
    found.verdict === "missing" && found.stairs?.length !== 0 && h("p", { class: "build" }, button(texts.build, texts.build, "build", actions.build)),
    unasked(job, found).map((each) => asked(texts, each, actions)),
  ];
}

/** Return what is asked for: all where no effect is likely, else what would let a rival of the likely one be tried. */
function unasked(job, found) {
  if (found.verdict === "adequate") return [];
  const isLikely = found.verdict === "missing" && found.candidates.some((each) => each.share >= LIKELY);
  return job.asked.filter((each) => !isLikely || each.effects.some((effect) => found.notExcluded.includes(effect)));
}

function asked(texts, each, actions) {
  const field = `ask-${each.key}`;
  return h("form", { class: "ask", submit: (event) => { event.preventDefault(); actions.state({ [`axis.${each.key}`]: event.target.elements.value.valueAsNumber }); } },
    h("p", {}, said(texts.ask, { effects: each.names.join(", ") })),
    h("label", { for: field }, each.name),
    h("input", { id: field, name: "value", type: "number", step: "any", min: Number.MIN_VALUE, required: true, "data-key": field, "aria-describedby": `${field}-unit` }),
    h("span", { id: `${field}-unit` }, each.unit),
    h("button", { type: "submit", "data-key": `state-${each.key}` }, texts.state));
}

/** What looks wrong in the data, each fault ringing its readings. */
export function faults(texts, found, point) {
  if (found.faults.length === 0) return [];
  return [
    h("h2", {}, texts.faults),
    h("ul", { class: "failures" }, found.faults.map((each, index) => h("li", {},
      h("button", { type: "button", class: "line", "data-key": `fault-${index}`, click: () => point("run", each.readings) },
        h("span", {}, sentence(each.statement), ". "), h("span", { class: "where" }, named(texts.remedy, each.remedy)),
        each.readings.length > 0 && h("span", { class: "unseen" }, ` – ${texts.show}`))))),
  ];
}

/** Where the model fails, each failure pointing at its readings. */
export function failures(texts, found, point) {
  return [
    h("h2", {}, texts.failures),
    found.failures.length === 0 && h("p", { class: "quiet" }, texts.noFailures),
    h("ul", { class: "failures" }, found.failures.map((each, index) => h("li", {},
      h("button", { type: "button", class: "line", "data-key": `failure-${index}`, click: () => point(each.axis, each.readings, each) },
        h("span", {}, sentence(each.statement), " "), h("span", { class: "where" }, [each.where, each.p].filter(Boolean).join("\u00a0· ")),
        h("span", { class: "unseen" }, ` – ${texts.show}`))))),
  ];
}

/** What may be missing, best first, equals in one group. */
export function candidates(texts, found, actions) {
  if (found.candidates.length === 0) return [];
  const serious = found.candidates.slice(0, Math.max(1, found.serious));
  const rest = found.candidates.slice(serious.length);
  return [
    h("h2", {}, texts.candidates),
    h("ol", { class: "candidates" }, grouped(serious).map((group) => h("li", { class: look(group) },
      group.map((each) => candidate(texts, each, actions)),
      group[0].equals.length > 0 && h("p", { class: "equals" }, group.length > 1 ? texts.alike : named(texts.equals, `${group[0].equalNames.join(", ")}.`)),
      !found.experiment && group[0].tell && h("p", { class: "tell" }, h("strong", {}, named(texts.tell)), group[0].tell)))),
    rest.length > 0 && h("ul", { class: "others" }, rest.map((each) => h("li", {},
      about(texts, each.effect, each.name), h("span", { class: "quiet" }, ` ${each.probability} · ${each.rmsAfter}`), add(texts, each, actions)))),
    found.notExcluded.length > 0 && h("p", { class: "quiet" }, named(texts.notExcluded, found.notExcludedNames.join(", "))),
  ];
}

/** The staircase of a build: each step takes the error further down, and is taken by a click; those before it with it. */
export function stairs(texts, job, made, number, actions) {
  if (!made) return [];
  const head = h("h2", {}, texts.stairs);
  if (made.state === "making") return [head, ...progress(texts, made, number, texts.building), button(texts.stop, texts.stop, "stop-build", () => actions.stopMaking("build"))];
  if (made.state === "failed") return [head, ...progress(texts, made, number, texts.building)];
  if (!made.stairs) return [];
  const present = new Set(job.effects.map((each) => each.effect));
  const open = made.stairs.findIndex((each) => each.removed === present.has(each.effect));
  const taken = open < 0 ? made.stairs.length : open;
  if (made.stairs.length === 0) return [head, h("p", { class: "quiet" }, texts.noStairs)];
  return [
    head, h("p", { class: "quiet" }, texts.stairsAre),
    h("ol", { class: "stairs" }, made.stairs.map((each, index) => h("li", { class: index < taken ? "taken" : false, "aria-current": index === taken - 1 ? "step" : false },
      h("div", { class: "heading" }, h("span", {}, index < taken && h("span", { "aria-hidden": "true" }, "✓ "), each.name), h("span", { class: "number" }, `${each.before} → `, h("strong", {}, each.after)),
        index >= taken && button(index === taken ? texts.takeStep : texts.upToHere, named(index === taken ? texts.takeStep : texts.upToHere, each.name), `stair-${index}`, () => actions.climb(made.stairs.slice(taken, index + 1)), index === taken ? "add" : false),
        index === taken - 1 && job.undo && button(texts.stepBack, texts.stepBack, "step-back", actions.undo)),
      bar(each.share, "fallen", each.floor ?? undefined)))),
  ];
}

/** The experiment that would decide the first tie, with the button that writes its job. */
export function experiment(texts, found, made, number, actions) {
  if (!found) return [];
  return [
    h("h2", {}, texts.experiment), h("p", {}, found.statement),
    found.job && made?.state !== "making" && h("button", { type: "button", "data-key": "experiment", click: () => actions.make("experiment", { effects: found.effects }) }, texts.writeJob),
    ...progress(texts, made, number, texts.simulating),
  ];
}

/** Return how a group of candidates is framed: strongly only what is likelier than not and can be. */
function look(group) {
  if (group.every((each) => !each.plausible)) return "impossible";
  return group.reduce((sum, each) => sum + each.share, 0) >= LIKELY ? "likely" : false;
}

function candidate(texts, each, actions) {
  const preview = () => actions.preview(each.argument, each.name);
  return h("article", { class: "candidate", pointerenter: preview, focusin: preview, pointerleave: () => actions.preview(null), focusout: () => actions.preview(null) },
    h("div", { class: "heading" }, h("h3", {}, about(texts, each.effect, each.name)), title(each), add(texts, each, actions)),
    h("div", { class: "gauge" }, h("span", {}, texts.probability), bar(each.share, "probability"), h("strong", {}, each.probability)),
    h("p", { class: "predicted" }, named(texts.errorAfter), each.rmsBefore, " → ", h("strong", {}, each.rmsAfter), " ", each.p && explained(h("span", { class: "quiet" }, each.p), texts.pIs)),
    h("p", {}, sentence(each.explains), "."),
    each.remedy && h("p", { class: "tell" }, h("strong", {}, named(texts.remedy)), each.remedy),
    wave(texts, each.name, actions.number, actions.wave(each.argument)),
    h("ul", { class: "parameters" }, each.parameters.map((own) => h("li", {}, symbol(own.symbol), ` = ${amount(own)} `, h("span", { class: "quiet" }, own.description), own.notes.length > 0 && !DOUBTS.has(own.plausibility) ? ", " : " ", notes(own)))),
  );
}

/** The effects of the model with their parameters. */
export function effects(texts, job, actions) {
  return [
    h("h2", {}, texts.model),
    job.effects.length === 0 && h("p", { class: "quiet" }, texts.noEffects),
    h("ul", { class: "effects" }, job.effects.map((each) => h("li", {},
      h("div", { class: "heading" }, h("h3", {}, about(texts, each.effect, each.name)), title(each),
        !each.stays && button(texts.remove, said(texts.removeEffect, { effect: each.name }), `remove-${each.effect}`, () => actions.remove(each.effect))),
      h("table", { class: "parameters", "aria-label": each.name }, h("tbody", {}, each.parameters.map((own) => h("tr", {},
        h("th", { scope: "row" }, symbol(own.symbol), " ", h("span", { class: "quiet" }, own.description)),
        h("td", { class: "number" }, own.fixed && actions.fix ? value(each, own, actions) : own.value), h("td", { class: "number" }, own.uncertainty ? `± ${own.uncertainty}` : ""), h("td", {}, own.unit),
        h("td", {}, notes(own)),
        h("td", {}, actions.fix && fixing(texts, each, own, actions)))))),
      wave(texts, each.name, actions.number, actions.wave(each.effect)),
    ))),
    h("form", { class: "other", submit: (event) => { event.preventDefault(); actions.add(event.target.elements.effect.value); } },
      h("label", { for: "other" }, texts.otherEffect),
      h("select", { id: "other", name: "effect", "data-key": "other" }, job.others.map((each) => h("option", { value: each.effect }, each.name === each.title ? each.title : named(each.name, each.title)))),
      h("button", { type: "submit", "data-key": "add-other" }, texts.add)),
  ];
}

function value({ effect, name }, own, actions) {
  return h("input", { type: "number", step: "any", required: true, value: own.number, "aria-label": `${called(effect, name, own)} (${own.unit})`, "data-key": `value-${effect}.${own.name}`,
    change: (event) => event.target.reportValidity() && actions.fix(effect, own.name, event.target.valueAsNumber) });
}

/** Return what a parameter is called: as in a job where effects are called so, else by what it is. */
function called(effect, name, own) {
  return name === effect ? `${effect}.${own.name}` : named(name, own.description);
}

function fixing(texts, { effect, name }, own, actions) {
  const key = `${effect}.${own.name}`;
  const parameter = called(effect, name, own);
  if (own.given && !own.fixed) return null;
  return own.fixed
    ? button(texts.free, said(texts.freeParameter, { parameter }), `hold-${key}`, () => actions.free(effect, own.name))
    : button(texts.fix, said(texts.fixParameter, { parameter }), `hold-${key}`, () => actions.fix(effect, own.name, own.number));
}

/** The fall chart: the error after each effect, down to the noise floor; a row shows its step in the graphs. */
export function fall(texts, results, actions) {
  const { heads: [first, ...heads], rows, floor } = results.fall;
  const seen = (step, name) => (step > 0 ? { pointerenter: () => actions.preview(String(step), name), pointerleave: () => actions.preview(null) } : {});
  const row = (label, { name, share, cells }, look, step = 0) => h("tr", { class: look, ...seen(step, name) },
    h("th", { scope: "row" }, label), h("td", { class: "bar" }, bar(share, look ?? "fallen", floor?.share)), cells.map((each) => h("td", { class: "number" }, each)));
  return [
    h("h2", {}, texts.fall),
    h("table", { class: "fall", "aria-label": texts.fall },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, first.text), h("td", {}), heads.map((each) => h("th", { scope: "col", class: "number" }, explained(each.text, each.meaning))))),
      h("tbody", {}, rows.map((each, step) => row(each.effect ? stepButton(each, step, actions) : each.label, each, undefined, step)),
        floor && row(explained(floor.label, texts.noiseFloorIs), floor, "floor"))),
  ];
}

function stepButton({ effect, name, label }, step, actions) {
  return h("button", { type: "button", class: "plain", "data-key": `step-${effect}`, focus: () => actions.preview(String(step), name), blur: () => actions.preview(null) }, label);
}

/** The parameters of the standards: now, and as forecast where a control compensates; the first standard open. */
export function standards(texts, results) {
  const forecast = [texts.forecast, results.moving].filter(Boolean).join(" ");
  return results.standards.map((each, index) => h("details", { open: index === 0 },
    h("summary", {}, index === 0 && [h("h2", {}, texts.standards), " · "], `${each.designation} · ${each.unit}`),
    standard(texts, each, forecast),
    each.unmet.length > 0 && h("ul", { class: "problems" }, each.unmet.map((one) => h("li", {}, one)))));
}

/** A parameter stands below the other on a small screen, and beside it on a wide one: so the roles are said. */
function standard(texts, each, forecast) {
  const limited = each.rows.some((row) => row.verdict);
  const stated = each.rows.some((row) => row.uncertainty);
  const foretold = each.rows.some((row) => row.by_table !== null);
  const heads = [texts.parameter, texts.now, ...(stated ? [explained("± U", texts.uIs)] : []), ...(limited ? [texts.limit] : []), ...(foretold ? [explained(texts.byTable, forecast), explained(texts.byModel, forecast)] : [])];
  const cell = (look, ...content) => h("td", { role: "cell", class: look }, content);
  return h("div", { class: "wide", tabindex: "0", role: "region", "aria-label": each.designation }, h("table", { class: "standard", role: "table" },
    h("thead", { role: "rowgroup" }, h("tr", { role: "row" }, heads.map((name, index) => h("th", { scope: "col", role: "columnheader", class: index ? "number" : false }, name)))),
    h("tbody", { role: "rowgroup" }, each.rows.map((row) => h("tr", { role: "row" },
      h("th", { scope: "row", role: "rowheader" }, explained(symbol(row.symbol), row.name)),
      cell("number now", row.value),
      stated && cell("number quiet", row.uncertainty && `± ${row.uncertainty}`),
      limited && cell(`number limit ${row.mark}`, row.limit, row.verdict && h("span", {}, ` ${row.verdict}`)),
      foretold && [cell("number", row.by_table), cell("number", row.by_model)])))));
}

/** What this test cannot see, and what was taken for granted. */
export function hidden(texts, found) {
  if (found.hidden.length + found.remarks.length === 0) return [];
  return [h("details", {}, h("summary", {}, h("h2", {}, texts.hidden)),
    h("ul", { class: "hidden" }, found.hidden.map((each) => h("li", {}, each.effects.map((effect, index) => [index > 0 && ", ", about(texts, effect, each.names[index])]), named("", each.reason)))),
    found.remarks.length > 0 && [h("h3", {}, texts.remarks), h("ul", { class: "hidden" }, found.remarks.map((each) => h("li", {}, each)))])];
}

/** The readings that are set aside, each with its reason and the way back. */
export function excluded(texts, job, actions) {
  if (job.excluded.length === 0) return [];
  return [
    h("h2", {}, texts.excluded),
    h("ul", { class: "excluded" }, job.excluded.map((each, index) => h("li", {},
      h("span", {}, named(`${each.reading}, ${texts.run} ${each.run}`, each.deviation), h("br"), h("q", {}, each.reason)),
      button(texts.bringBack, named(texts.bringBack, `${each.reading}, ${texts.run} ${each.run}`), `include-${index}`, () => actions.include(index))))),
  ];
}

/** What the job lacks to be a calibration certificate, as fields; those that are filled in are written into it. */
export function lacking(texts, fields, actions) {
  if (fields.length === 0) return [];
  const send = (event) => {
    event.preventDefault();
    const filled = [...event.target.elements].filter((each) => each.name && each.value.trim());
    actions.state(Object.fromEntries(filled.map((each) => [each.name, each.type === "number" ? each.valueAsNumber : each.value.trim()])));
  };
  return [h("form", { class: "lacking", submit: send },
    h("p", {}, texts.lacking),
    h("dl", {}, fields.map((each) => h("div", {}, h("dt", {}, h("label", { for: `lacks-${each.key}` }, each.name)), h("dd", {}, field(texts, each))))),
    h("button", { type: "submit", "data-key": "state-lacking" }, texts.state))];
}

function field(texts, each) {
  const named = { id: `lacks-${each.key}`, name: each.key, "data-key": `lacks-${each.key}` };
  if (each.form === "place") {
    return h("select", { ...named, name: `${each.key}.kind` }, h("option", { value: "" }), h("option", { value: "laboratory" }, texts.atLaboratory), h("option", { value: "customer" }, texts.atCustomer));
  }
  return [
    h("input", { ...named, type: each.form, step: each.form === "number" ? "any" : false, min: each.key.startsWith("uncertainty.") ? 0 : false, maxlength: each.form === "text" ? 300 : false, autocomplete: "off" }), each.unit && ` ${each.unit}`,
    each.reason && h("label", { class: "reason" }, ` ${texts.orNegligible} `, h("input", { type: "text", name: each.reason, maxlength: 300, autocomplete: "off", "data-key": `lacks-${each.reason}` })),
  ];
}

/** The certificate: its formats, made from the page, its files, and its pages as pictures. */
export function certificate(texts, job, made, wanted, number, actions) {
  const chosen = (each) => wanted.certificate?.formats.includes(each.format) ?? each.chosen;
  return [
    h("h2", {}, texts.certificate),
    h("form", { class: "making", submit: (event) => { event.preventDefault(); actions.make("certificate", { formats: new FormData(event.target).getAll("format") }); } },
      h("fieldset", {}, h("legend", {}, texts.formats), job.offered.formats.map((each) => h("label", {},
        h("input", { type: "checkbox", name: "format", value: each.format, checked: chosen(each) }), ` ${each.format}`))),
      h("button", { type: "submit", "data-key": "certificate", disabled: made?.state === "making" }, texts.makeCertificate)),
    ...progress(texts, made, number, texts.making),
    made?.state === "made" && Object.keys(made.pages).length > 0 && button(texts.lookAtPages, texts.lookAtPages, "look-at-pages", actions.lookAtPages),
  ];
}

/** Return how far something is that is being made, or its files, or what stood against it. */
function progress(texts, made, number, words) {
  if (made?.state === "making") {
    return [h("p", { class: "progress" }, h("progress", { "aria-label": words }), ` ${words} `, h("span", { "aria-hidden": "true" }, said(texts.seconds, { seconds: number(made.seconds) })))];
  }
  return [
    made?.state === "made" && h("ul", { class: "files" }, made.files.map((name) => h("li", {}, h("a", { href: `${ROOT}/documents/${name}`, download: name }, name)))),
    made?.state === "made" && !made.current && h("p", { class: "quiet" }, texts.outOfDate),
    made?.state === "failed" && h("ul", { class: "problems" }, made.problems.map((each) => h("li", {}, each))),
  ];
}

/** The pages as pictures, one at a time: those of the sheet first, then those of the certificate. */
export function preview(texts, made, close) {
  const all = Object.entries(made.pages).flatMap(([name, pages]) => Array.from({ length: pages }, (_, index) => ({ name, page: index + 1, pages })));
  const picture = h("img", { class: "page", alt: "" });
  const place = h("span", { role: "status" });
  let shown = 0;
  const turn = (to) => {
    shown = Math.max(0, Math.min(all.length - 1, to));
    const { name, page, pages } = all[shown];
    picture.src = `${ROOT}/documents/${name}/${page}.png?of=${made.stamp}`;
    picture.alt = said(name === "sheet" ? texts.sheetPage : texts.page, { page, pages });
    place.textContent = picture.alt;
  };
  turn(0);
  return [
    h("div", { class: "heading" }, h("h2", {}, texts.certificate),
      button("←", texts.pageBefore, "page-before", () => turn(shown - 1)), place, button("→", texts.pageAfter, "page-after", () => turn(shown + 1)),
      button(texts.close, texts.close, "close-pages", close)),
    picture];
}

/** The table for a control: written, its forecast, and a second test held against it. */
export function compensation(texts, job, made, wanted, number, actions) {
  const { offered } = job;
  if (!offered.takesTable) return [];
  const before = wanted.table ?? { controller: (offered.controllers.find((each) => each.chosen) ?? offered.controllers.find((each) => each.isVerified))?.controller };
  if (!offered.tableIsStated) {
    return [h("h2", {}, texts.compensation), h("p", {}, texts.whichTable), button(texts.noTable, texts.noTable, "no-table", actions.noTable)];
  }
  const chosen = (form) => {
    const values = new FormData(form);
    return { controller: values.get("controller"), step: values.get("step") ? Number(values.get("step")) : null, unconfirmed: values.has("unconfirmed") };
  };
  const { table, confirmation } = made;
  const form = h("form", { class: "making", submit: (event) => { event.preventDefault(); actions.make("table", chosen(form)); } },
    h("label", { for: "controller" }, texts.controller),
    h("select", { id: "controller", name: "controller", "data-key": "controller" }, offered.controllers.map((each) =>
      h("option", { value: each.controller, selected: each.controller === before.controller }, each.isVerified ? each.title : said(texts.untried, { controller: each.title })))),
    h("label", { for: "step" }, texts.step), h("input", { id: "step", name: "step", type: "number", step: "any", min: 0, value: before.step, placeholder: texts.atTargets, "data-key": "step" }), h("span", {}, offered.unit),
    h("label", {}, h("input", { type: "checkbox", name: "unconfirmed", checked: before.unconfirmed }), ` ${texts.unconfirmed}`),
    h("button", { type: "submit", "data-key": "table", disabled: table?.state === "making" }, texts.writeTable));
  const second = h("form", { class: "making", submit: (event) => { event.preventDefault(); actions.make("confirmation", { controller: chosen(form).controller, unconfirmed: true, after: event.target.elements.after.value }); } },
    h("label", { for: "after" }, texts.secondTest),
    h("select", { id: "after", name: "after", "data-key": "after" }, offered.jobs.map((name) => h("option", { value: name, selected: name === wanted.confirmation?.after }, name))),
    h("button", { type: "submit", "data-key": "confirm" }, texts.hold));
  return [
    h("h2", {}, texts.compensation), form,
    ...progress(texts, table, number, texts.writing),
    table?.values?.forecast && forecast(texts, table.values, offered.unit),
    offered.jobs.length > 0 && second,
    ...progress(texts, confirmation, number, texts.holding),
    confirmation?.values?.verdict && h("p", { class: `verdict ${confirmation.values.verdict === "held" ? "adequate" : "unexplained"}` },
      `${texts[CONFIRMED[confirmation.values.acts]]} ${said(texts.left, { share: number(Math.round(1000 * confirmation.values.ratio) / 10) })}`),
  ];
}

function forecast(texts, values, position) {
  const { before, after, between_grid_points: between } = values.forecast;
  const unit = PRINTED[values.unit] ?? values.unit;
  const rounded = (value) => fixed(value, 2);
  return h("div", {},
    h("table", { "aria-label": texts.withTable },
      h("thead", {}, h("tr", {}, h("td", {}), h("th", { scope: "col", class: "number" }, `${texts.now} (${unit})`), h("th", { scope: "col", class: "number" }, `${texts.withTable} (${unit})`))),
      h("tbody", {}, Object.keys(before).map((name) => h("tr", {}, h("th", { scope: "row" }, h("i", {}, name)), h("td", { class: "number" }, rounded(before[name])), h("td", { class: "number" }, rounded(after[name])))))),
    h("p", { class: "quiet" }, said(texts.betweenRows, { rows: values.rows, largest: withUnit(rounded(between.largest), unit), at: withUnit(rounded(between.at), position) }), " ", texts.noMeasurement));
}

/** What was done so far, the last step first. */
export function steps(texts, job) {
  return [
    h("h2", {}, texts.changes),
    job.steps.length === 0
      ? h("p", { class: "quiet" }, texts.noChanges)
      : h("ol", { class: "steps" }, job.steps.map((each) => h("li", {}, h("time", {}, each.at), " ", each.text))),
  ];
}

function grouped(all) {
  const groups = [];
  for (const each of all) {
    const group = groups.find((one) => one[0].equals.includes(each.effect));
    if (group) group.push(each);
    else groups.push([each]);
  }
  return groups;
}

function about(texts, effect, name) {
  return texts.machine ? name : h("a", { href: `${ROOT}/effects/${effect}${location.search}`, "data-key": `about-${effect}` }, name);
}

/** Return what an effect is called beside its name, where that says more. */
function title(each) {
  return each.title !== each.name && h("span", { class: "quiet" }, each.title);
}

function add(texts, each, actions) {
  return button(texts.add, said(texts.addEffect, { effect: each.name }), `add-${each.effect}`, () => actions.add(each.argument), "add");
}

function button(label, name, key, click, look) {
  return h("button", { type: "button", class: look, "aria-label": name, "data-key": key, click }, label);
}

function amount(own) {
  return withUnit(`${own.value}${own.uncertainty ? ` ± ${own.uncertainty}` : ""}`, own.unit);
}

/** How a parameter is known where that is not by its U alone, and how it lies to what is usual or expected. */
function notes(own) {
  if (own.notes.length === 0) return null;
  return h("span", { class: DOUBTS.has(own.plausibility) ? `doubt ${own.plausibility}` : "note" }, own.notes.join(", "));
}

/** A bar of a length from 0 to 1, with a mark at the noise floor. */
function bar(share, look, floor) {
  return s("svg", { class: `amount ${look}`, viewBox: "0 0 100 10", preserveAspectRatio: "none", "aria-hidden": "true" },
    s("rect", { class: "whole", x: 0, y: 0, width: 100, height: 10 }),
    s("rect", { class: "part", x: 0, y: 0, width: Math.max(0.5, 100 * share), height: 10 }),
    floor !== undefined && s("rect", { class: "at", x: 100 * floor - 0.3, y: 0, width: 0.6, height: 10 }));
}

function sentence(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
