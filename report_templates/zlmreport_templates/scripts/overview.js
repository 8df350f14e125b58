"use strict";
// Search, choice and order of the axes, graphs that are packed, and the way back from a trend. Without this script
// the page shows all axes, machine by machine, and the graphs of what needs somebody; and a link leads back.
const folded = (text) => text.toLowerCase().replace(/\s+/g, " ");
const tools = document.getElementById("search");
const table = document.querySelector("table.machine");
// What a reader may look for: what is written, and the numbers of certificates; not the scales of graphs.
const textOf = (row) => folded([...row.cells].filter((cell) => !cell.classList.contains("course"))
  .flatMap((cell) => [cell.textContent, ...[...cell.querySelectorAll("a")].map((link) => link.ariaLabel)]).join(" "));

if (tools) {
  const [search, choice, order] = ["search", "choice", "order"].map((name) => tools.elements[name]);
  const found = tools.querySelector("output");
  const others = [...document.querySelectorAll("main tbody")].filter((body) => body.parentNode !== table)
    .map((body) => ({ body, text: [...body.rows].map(textOf).join(" ") }));
  const machines = [...table.tBodies].map((body, place) => {
    const [name, ...rows] = body.rows;
    const axes = [];
    for (const row of rows) {
      if (row.dataset.measured) axes.push({ ...row.dataset, rows: [], place: axes.length, text: `${textOf(name)} ` });
      const axis = axes.at(-1);
      axis.rows.push(row);
      axis.text += `${textOf(row)} `;
    }
    return { body, place, axes };
  });
  const comparisons = {
    machine: (one, other) => one.place - other.place,
    used: (one, other) => Number(other.used || -1) - Number(one.used || -1),
    due: (one, other) => (one.due || "9").localeCompare(other.due || "9"),
    measured: (one, other) => one.measured.localeCompare(other.measured),
  };

  const show = () => {
    const words = folded(search.value).split(" ");
    const says = (each) => words.every((word) => each.text.includes(word));
    for (const each of others) each.body.hidden = !says(each);
    let shown = 0;
    for (const machine of machines) {
      let here = 0;
      for (const axis of machine.axes) {
        const isMeant = (choice.value === "" || axis.marks.split(" ").includes(choice.value)) && says(axis);
        for (const row of axis.rows) row.hidden = !isMeant;
        here += isMeant;
      }
      machine.body.hidden = here === 0;
      shown += here;
    }
    for (const block of document.querySelectorAll("main .block")) {
      block.hidden = ![...block.querySelectorAll("tbody")].some((body) => !body.hidden);
    }
    found.textContent = found.dataset.text.replace("{shown}", shown);
  };
  // A machine stands where the first of its axes would, and its axes follow each other in the same order.
  const arrange = () => {
    const compare = (one, other) => comparisons[order.value](one, other) || one.place - other.place;
    for (const machine of machines) {
      machine.axes.sort(compare);
      machine.body.append(...machine.axes.flatMap((axis) => axis.rows));
    }
    const first = order.value === "machine" ? (one, other) => one.place - other.place : (one, other) => compare(one.axes[0], other.axes[0]) || one.place - other.place;
    table.append(...[...machines].sort(first).map((each) => each.body));
  };

  tools.hidden = document.getElementById("choices").hidden = false;
  tools.addEventListener("submit", (event) => event.preventDefault());
  search.addEventListener("input", show);
  choice.addEventListener("change", show);
  order.addEventListener("change", arrange);
  show();
}

// Graphs of what needs nobody are packed, some axes together: a pack is opened when one of its rows is seen.
const packs = [...document.querySelectorAll("script[data-first]")];
const findPack = (number) => packs.findLast((each) => Number(each.dataset.first) <= Number(number));
const unpack = async (pack) => {
  if (!pack || pack.dataset.opened) return;
  pack.dataset.opened = "1";
  const bytes = Uint8Array.from(atob(pack.textContent), (each) => each.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const holder = document.createElement("template");
  holder.innerHTML = await new Response(stream).text();
  for (const link of holder.content.querySelectorAll("a.to-trend")) {
    const places = document.querySelectorAll(`td[data-trend="${link.hash.replace("#trend-", "")}"]`);
    for (const place of places) place.replaceChildren(link.cloneNode(true));
  }
  pack.before(...holder.content.querySelectorAll("article"));
};
const seen = new IntersectionObserver((changes) => {
  for (const { isIntersecting, target } of changes) {
    if (!isIntersecting) continue;
    seen.unobserve(target);
    for (const place of target.querySelectorAll("[data-trend]")) unpack(findPack(place.dataset.trend));
  }
}, { rootMargin: "50%" });
for (const body of document.querySelectorAll("tbody:has([data-trend])")) seen.observe(body);
// The address of a trend that is packed leads to it once it is there.
const [, asked] = location.hash.match(/^#trend-(\d+)$/) ?? [];
if (asked && !document.querySelector(location.hash)) unpack(findPack(asked)).then(() => location.replace(location.hash));

// A trend lies over the page: Escape, or a click beside it, leads back to where one was.
const leave = () => { if (location.hash.startsWith("#trend-")) history.length > 1 ? history.back() : (location.hash = "axes"); };
addEventListener("keydown", (event) => { if (event.key === "Escape") leave(); });
addEventListener("click", (event) => { if (event.target.matches("article.trend")) leave(); });
addEventListener("hashchange", () => document.querySelector("article.trend:target")?.focus());
