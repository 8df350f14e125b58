"use strict";
// Search, choice and order of the axes, and the way back from a trend. Without this script the page shows all of
// them, machine by machine, and a link leads back.
const folded = (text) => text.toLowerCase().replace(/\s+/g, " ");
const tools = document.getElementById("tools");
const table = document.querySelector("table.machine");

if (tools) {
  const [search, choice, order] = ["search", "choice", "order"].map((name) => tools.elements[name]);
  const found = tools.querySelector("output");
  const others = [...document.querySelectorAll("main tbody")].filter((body) => body.parentNode !== table)
    .map((body) => ({ body, text: folded(body.textContent) }));
  const machines = [...table.tBodies].map((body, place) => {
    const axes = new Map();
    for (const row of [...body.rows].slice(1)) {
      if (!axes.has(row.dataset.axis)) axes.set(row.dataset.axis, { ...row.dataset, rows: [], place: axes.size, text: "" });
      const axis = axes.get(row.dataset.axis);
      axis.rows.push(row);
      axis.text += folded(`${body.rows[0].textContent} ${row.textContent} `);
    }
    return { body, place, axes: [...axes.values()] };
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

  tools.hidden = false;
  tools.addEventListener("submit", (event) => event.preventDefault());
  search.addEventListener("input", show);
  choice.addEventListener("change", show);
  order.addEventListener("change", arrange);
  show();
}

// A trend lies over the page: Escape, or a click beside it, leads back to where one was.
const leave = () => { if (location.hash.startsWith("#trend-")) history.length > 1 ? history.back() : (location.hash = "axes"); };
addEventListener("keydown", (event) => { if (event.key === "Escape") leave(); });
for (const trend of document.querySelectorAll("article.trend")) {
  trend.addEventListener("click", (event) => { if (event.target === trend) leave(); });
}
addEventListener("hashchange", () => document.querySelector("article.trend:target")?.focus());
