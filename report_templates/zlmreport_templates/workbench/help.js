// Words that explain themselves: a button of the word, and what it means over the page.

import { h } from "./dom.js";

let count = 0;

/** Return a word as a button that says what it means; the word alone where nothing is said of it. */
export function explained(word, meaning) {
  if (!meaning) return word;
  const identifier = `help-${(count += 1)}`;
  return [
    h("button", { type: "button", class: "term", popovertarget: identifier, "aria-describedby": identifier }, word),
    h("span", { id: identifier, class: "meaning", popover: "auto", role: "note" }, meaning)];
}
