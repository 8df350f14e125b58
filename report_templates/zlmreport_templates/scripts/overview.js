"use strict";
// Search, choice and order of the axes. Without this script the page shows all of them, machine by machine.
const folded = (text) => text.toLowerCase().replace(/\s+/g, " ");
const tools = document.getElementById("tools");
const table = document.querySelector("table.machine");

if (tools) {
  const [search, choice, order] = ["search", "choice", "order"].map((name) => tools.elements[name]);
  const found = tools.querySelector("output");
  const groups = [...document.querySelectorAll("main tbody")].map((body, place) => ({
    body, place, isAxis: body.parentNode === table, text: folded(body.textContent), ...body.dataset,
  }));
  const axes = groups.filter((each) => each.isAxis);
  const comparisons = {
    machine: (one, other) => one.place - other.place,
    used: (one, other) => Number(other.used || -1) - Number(one.used || -1),
    due: (one, other) => (one.due || "9").localeCompare(other.due || "9"),
    measured: (one, other) => one.measured.localeCompare(other.measured),
  };

  const show = () => {
    const words = folded(search.value).split(" ");
    for (const each of groups) {
      const isMeant = choice.value === "" || !each.isAxis || each.marks.split(" ").includes(choice.value);
      each.body.hidden = !(isMeant ? words.every((word) => each.text.includes(word)) : false);
    }
    for (const block of document.querySelectorAll("main .block")) {
      block.hidden = ![...block.querySelectorAll("tbody")].some((body) => !body.hidden);
    }
    const shown = axes.filter((each) => !each.body.hidden).length;
    found.textContent = found.dataset.text.replace("{shown}", shown).replace("{all}", axes.length);
  };
  const arrange = () => {
    const arranged = [...axes].sort((one, other) => comparisons[order.value](one, other) || one.place - other.place);
    table.append(...arranged.map((each) => each.body));
  };

  tools.hidden = false;
  tools.addEventListener("submit", (event) => event.preventDefault());
  search.addEventListener("input", show);
  choice.addEventListener("change", show);
  order.addEventListener("change", arrange);
  show();
}
