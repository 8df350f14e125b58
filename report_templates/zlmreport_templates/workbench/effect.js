// The page of an effect: equation, look, parameters, and what it cannot be told from.

import { h, named, said, symbol } from "./dom.js";
import { withUnit, written } from "./number.js";
import { Plot } from "./plot.js";
import { ROOT, get } from "./server.js";

/** Show an effect. */
export async function showEffect(texts, effect) {
  let found;
  try {
    found = await get(`/api/effects/${effect}`);
  } catch (error) {
    document.body.replaceChildren(h("main", {}, back(texts), h("ul", { class: "notice" }, (error.problems ?? [texts.gone]).map((each) => h("li", {}, each)))));
    return;
  }
  document.title = found.called === found.title ? found.title : `${found.called} · ${found.title}`;
  const plot = found.sketch && drawn(texts, found);
  document.body.replaceChildren(
    h("header", {}, h("h1", {}, found.called, found.called !== found.title && [" ", h("span", {}, found.title)]), back(texts)),
    h("main", { class: "effect" },
      h("section", { class: "panel" }, h("h2", {}, texts.look), h("p", {}, found.look),
        found.remedy && h("p", {}, h("strong", {}, named(texts.remedy)), found.remedy),
        plot && [plot.element, h("p", { class: "hint" }, found.sketch.words)]),
      h("div", {},
        h("section", { class: "panel" }, h("h2", {}, texts.equation), h("p", { class: "equation" }, symbol(found.equation)), table(texts, found),
          found.parameters.some((each) => each.low !== null || each.high !== null) && h("p", { class: "quiet" }, said(texts.rangesFrom, { source: found.rangesFrom })),
          found.containsNames.length > 0 && h("p", {}, said(texts.contains, { effects: found.containsNames.join(", ") }))),
        found.estimates.length > 0 && h("section", { class: "panel" }, h("h2", {}, texts.estimated),
          h("ul", { class: "parameters" }, found.estimates.map((each) => h("li", {}, symbol(each.symbol), ` = ${withUnit(`${each.value}${each.uncertainty && ` ± ${each.uncertainty}`}`, each.unit)}`)))),
        found.keys.length > 0 && h("section", { class: "panel" }, h("h2", {}, texts.keys),
          h("dl", { class: "keys" }, found.keys.map((each) => [h("dt", {}, h("code", {}, each.name)), h("dd", {}, each.description)]))),
        found.confusions.length > 0 && h("section", { class: "panel" }, h("h2", {}, texts.confusions),
          h("dl", { class: "keys" }, found.confusions.map((each) => [
            h("dt", {}, h("a", { href: `${ROOT}/effects/${each.effect}${location.search}` }, each.called), each.called !== each.title && h("span", { class: "quiet" }, ` ${each.title}`)),
            h("dd", {}, h("strong", {}, named(texts.tell)), each.told)]))))));
}

function back(texts) {
  return h("a", { href: `${ROOT}/${location.search}`, "data-key": "back" }, texts.back);
}

function table(texts, found) {
  const range = (each) => (each.low === null && each.high === null ? "–" : `${each.low ?? "−∞"} … ${each.high ?? "∞"}`);
  return h("table", { "aria-label": texts.parameters },
    h("thead", {}, h("tr", {}, [texts.parameters, "", texts.range].map((name, index) => (name ? h("th", { scope: "col", class: index === 2 ? "number" : false }, name) : h("td", {}))))),
    h("tbody", {}, found.parameters.map((each) => h("tr", {}, h("th", { scope: "row" }, symbol(each.symbol)), h("td", {}, each.description),
      h("td", { class: "number" }, withUnit(range(each), each.unit))))));
}

function drawn(texts, found) {
  const { sketch } = found;
  const quiet = () => {};
  const plot = new Plot({ label: texts.look, hint: "", number: written, marked: (index) => plot.ring(index === null ? [] : [index], true), pinned: quiet, zoomed: quiet, boxed: quiet });
  plot.show({
    hidden: new Set(),
    x: sketch.x, y: sketch.y, direction: sketch.direction, fitted: sketch.x.map(() => true), curves: sketch.curves, noise: null, labels: null, range: sketch.range,
    xTitle: sketch.unit ? `${sketch.title} (${sketch.unit})` : sketch.title, yTitle: `${texts.deviation} (${sketch.deviation_unit})`, alternative: `${found.look} ${sketch.words}`,
  });
  return plot;
}
