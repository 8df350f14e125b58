// Numbers as readers of the page write them.

const DIGITS = 6;
const SMALLEST = 1e-9;

/** Return a number as text: the decimal sign of the language, a minus that is one. */
export function written(value) {
  const format = new Intl.NumberFormat(document.documentElement.lang, { maximumSignificantDigits: DIGITS, useGrouping: false });
  return format.format(Math.abs(value) < SMALLEST ? 0 : value).replace("-", "−");
}

/** Return a number with so many decimals. */
export function fixed(value, decimals) {
  const format = new Intl.NumberFormat(document.documentElement.lang, { minimumFractionDigits: decimals, maximumFractionDigits: decimals, useGrouping: false });
  return format.format(Math.abs(value) < SMALLEST ? 0 : value).replace("-", "−");
}
