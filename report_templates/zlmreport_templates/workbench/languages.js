// The choice of a language: the page is asked for again in it.

import { h } from "./dom.js";

const NAMES = { en: "English", de: "Deutsch", fr: "Français", it: "Italiano", es: "Español" };

/** Return the choice, with the language of this page chosen. */
export function languageChoice(texts) {
  const here = document.documentElement.lang;
  const options = Object.entries(NAMES).map(([code, name]) => h("option", { value: code, lang: code, selected: code === here }, name));
  return h("select", { "aria-label": texts.language, "data-key": "language", change: ({ target }) => { location.search = `?lang=${target.value}`; } }, options);
}
