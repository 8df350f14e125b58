// One wave instead of sixty: the readings of an effect that repeats, laid over each other at its period.

import { beside, fill, h, named } from "./dom.js";
import { Plot } from "./plot.js";

/** Return a place that shows the wave of an effect once `asked` has it; nothing where the effect does not repeat. */
export function wave(texts, name, number, asked) {
  const place = h("div", { class: "wave" });
  asked.then((found) => found && place.isConnected && fill(place, h("h4", {}, named(texts.oneWave, name)), drawn(texts, found, number)));
  return place;
}

function drawn(texts, found, number) {
  const quiet = () => {};
  const plot = new Plot({ label: texts.oneWave, hint: "", number, marked: (index) => plot.ring(index === null ? [] : [index], true), pinned: quiet, zoomed: quiet, boxed: quiet });
  plot.show({
    ...found, hidden: new Set(), fitted: found.x.map(() => true), noise: null, labels: null, alternative: `${beside(found.yTitle, found.xTitle)}.`,
  });
  return plot.element;
}
