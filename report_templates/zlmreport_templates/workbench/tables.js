// Tables across the axes of a machine: which control, which way its values act, forecast, files, circles run again.

import { section } from "./blocks.js";
import { h } from "./dom.js";
import { ROOT } from "./server.js";

/** Return the panel; the forecast is seen before anything is written. */
export function crossTables(texts, job, made, wanted, actions) {
  const { controllers, circles } = job.offered.tables;
  if (!controllers?.length) return [];
  const chosen = controllers.find((each) => each.controller === wanted?.controller) ?? controllers[0];
  const needsTrial = !chosen.isSignKnown && !wanted?.moves;
  const read = (form, action) => {
    const values = new FormData(form);
    const again = values.getAll("circle").filter(Boolean);
    return { action, controller: values.get("controller"), moves: values.get("moves") ?? "", step: values.get("step") ? Number(values.get("step")) : null, circles: again };
  };
  const asked = (action) => ({ type: "button", "data-key": `tables-${action}`, click: (event) => actions.tables(read(event.target.form, action)) });
  const changed = (event) => actions.chooseTables(read(event.target.form, "forecast"));
  const isSeen = made?.current && ["forecast", "write"].includes(made.action);
  return [
    h("h2", {}, texts.compensation),
    h("form", { class: "making", submit: (event) => event.preventDefault() },
      h("label", { for: "control" }, texts.controller),
      h("select", { id: "control", name: "controller", "data-key": "control", change: changed }, controllers.map((each) =>
        h("option", { value: each.controller, selected: each === chosen }, each.title))),
      !chosen.isSignKnown && [
        h("label", { for: "moves" }, texts.positiveValue),
        h("select", { id: "moves", name: "moves", "data-key": "moves", change: changed }, [["", texts.notKnown], ["plus", texts.plus], ["minus", texts.minus]].map(([value, name]) =>
          h("option", { value, selected: value === (wanted?.moves ?? "") }, name)))],
      h("label", { for: "rows" }, texts.step),
      h("input", { id: "rows", name: "step", type: "number", step: "any", min: 0, value: wanted?.step, placeholder: texts.asMeasured, "data-key": "rows" }), h("span", {}, "mm"),
      needsTrial ? h("button", asked("trial"), texts.writeTrial) : h("button", asked("forecast"), texts.showForecast),
      isSeen && h("button", asked("write"), texts.writeTable),
      !needsTrial && circles.length > 0 && h("span", { class: "making" },
        h("label", { for: "circle" }, texts.secondTest),
        h("select", { id: "circle", name: "circle", "data-key": "circle" }, ["", ...circles].map((name) => h("option", { value: name, selected: wanted?.circles?.includes(name) }, name))),
        h("button", asked("confirm"), texts.hold))),
    made?.files.length > 0 && h("ul", { class: "files" }, made.files.map((name) => h("li", {}, h("a", { href: `${ROOT}/documents/${name}`, download: name }, name)))),
    made && !made.current && h("p", { class: "quiet" }, texts.outOfDate),
    made?.sections.map((each) => section(each)),
  ];
}
