// Blocks as terminal and certificate have them, laid out on a page: sentences, notices, tables, drawings.

import { h, named, s, symbol } from "./dom.js";
import { explained } from "./help.js";

/** Return a section: its title and its blocks; one that is folded opens by a click. */
export function section(values, isFolded = false) {
  const title = h("h2", {}, values.title);
  const inside = blocks(values.blocks, values.title);
  return isFolded ? h("details", {}, h("summary", {}, title), inside) : [title, inside];
}

/** Return blocks one after the other; a heading that repeats `title`, or the block before it, is left out. */
export function blocks(all, title = "") {
  return all.map((each, index) => KINDS[each.kind](each, index > 0 && all[index - 1].text ? all[index - 1].text : title));
}

const KINDS = {
  paragraph: ({ text }) => h("p", {}, text),
  notice: ({ heading, items }, title) => [heading !== title && h("p", { class: "said" }, named(heading)), h("ul", { class: "said" }, items.map((each) => h("li", {}, each)))],
  facts: ({ pairs }) => h("dl", { class: "numbers" }, pairs.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value)))),
  table: (each, title) => table(each, title),
  graph: ({ caption, drawing }) => h("figure", {}, h("div", { class: "drawing" }, drawn(drawing)), h("figcaption", { class: "hint" }, caption)),
};

/** Return a table; `first` may turn the first cell of a row into something else. */
export function table({ caption, columns, groups }, title = "", first = content) {
  return h("div", { class: "wide", tabindex: "0", role: "region", "aria-label": caption },
    h("table", { class: "said" },
      caption !== title && h("caption", {}, caption),
      h("thead", {}, h("tr", {}, columns.map((each) => h("th", { scope: "col", class: each.right ? "number" : false }, content(each.heading), each.unit && ` (${each.unit})`)))),
      groups.map(({ heading, rows }) => h("tbody", {},
        heading && h("tr", {}, h("th", { scope: "rowgroup", colspan: columns.length || false }, heading)),
        rows.map((row) => h("tr", {}, row.map((cell, index) => (index === 0
          ? h("th", { scope: "row" }, first(cell))
          : h("td", { class: columns[index]?.right ? "number" : false }, content(cell))))))))));
}

function content(cell) {
  if (cell.symbol) return symbol(cell.symbol);
  return cell.meaning ? explained(cell.text, cell.meaning) : cell.text;
}

/** Return a drawing from its elements: name, attributes, and what each holds. */
function drawn([name, attributes, inside]) {
  const { width, height, ...kept } = attributes;
  return s(name, name === "svg" ? kept : attributes, typeof inside === "string" ? inside : inside.map(drawn));
}
