// Elements from values: text is always text, never markup.

const SVG = "http://www.w3.org/2000/svg";
// Between a number and its unit no line ends.
const UNIT = /(?<=\d) (?=(?:[µmn]?m|s|min|K|hPa|°C|%)(?!\w))/g;

/** Return an element with attributes (functions are listeners, false and null leave one out) and children. */
export function h(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** Return an element of a drawing. */
export function s(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  const kept = children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false);
  element.append(...kept.map((child) => (typeof child === "string" && element.tagName !== "CODE" ? child.replace(UNIT, "\u00a0") : child)));
  return element;
}

/** Return a symbol: its stretches, italic where they are quantities, lowered where they are subscripts. */
export function symbol(spans) {
  return h("span", { class: "symbol" }, spans.map((span) => {
    const text = span.italic ? h("i", {}, span.text) : span.text;
    return span.subscript ? h("sub", {}, text) : text;
  }));
}

/** Return a phrase with values in its marked places. */
export function said(phrase, values) {
  return phrase.replace(/\{(\w+)\}/g, (_, name) => values[name]);
}

/** Return a name and what is said of it, as the language of the page parts them. */
export function named(name, text = "") {
  return `${name}${space()}: ${text}`;
}

/** Return two parts of a line, as the language of the page parts them. */
export function beside(first, second) {
  return `${first}${space()}; ${second}`;
}

/** Return what stands before a colon and a semicolon. */
function space() {
  return document.documentElement.lang === "fr" ? "\u00a0" : "";
}

const HEADING = "heading";

/**
 * Fill an element anew; the control that had the focus has it again if it is still there.
 *
 * Else the first control beside it has it; where none is left, the heading, or that of the page's first part: who
 * works by keys goes on there, and not at the top of the page.
 */
export function fill(element, ...children) {
  const focused = element.contains(document.activeElement) ? document.activeElement.dataset.key : null;
  element.replaceChildren(...children.flat(Infinity).filter(Boolean));
  if (!focused) return;
  const again = [...element.querySelectorAll("[data-key]")].find((each) => each.dataset.key === focused);
  const control = focused === HEADING ? null : element.querySelector("button, a[href], select, input");
  const next = again ?? control ?? element.querySelector("h2") ?? document.querySelector("main h2");
  if (next?.tagName === "H2") {
    next.tabIndex = -1;
    next.dataset.key = HEADING;
  }
  next?.focus();
}
