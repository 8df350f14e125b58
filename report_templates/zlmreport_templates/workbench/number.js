// Numbers as readers of the page write them.

const DIGITS = 6;
// Of what was read: all that came, and nothing that a double adds.
export const ALL_DIGITS = 12;
// Signs of angles touch their number; what begins with the sign of seconds does, too.
const TOUCHING = ["°", "″"];
const SMALLEST = 1e-9;

/** Return a number as text: the decimal sign of the language, a minus that is one. */
export function written(value, digits = DIGITS) {
  const format = new Intl.NumberFormat(document.documentElement.lang, { maximumSignificantDigits: digits, useGrouping: false });
  return format.format(Math.abs(value) < SMALLEST ? 0 : value).replace("-", "−");
}

/** Return a deviation in few digits: two decimals, and of one below 1 three digits. */
export function shortened(value) {
  return Math.abs(value) < 1 ? Number(value.toPrecision(3)) : Math.round(100 * value) / 100;
}

/** Return a number with so many decimals. */
export function fixed(value, decimals) {
  const format = new Intl.NumberFormat(document.documentElement.lang, { minimumFractionDigits: decimals, maximumFractionDigits: decimals, useGrouping: false });
  return format.format(Math.abs(value) < SMALLEST ? 0 : value).replace("-", "−");
}

/** Return a number that is written, with its unit as documents print it: `20 µm`, `20″`, `(4.2 ± 0.3)″`. */
export function withUnit(number, unit) {
  if (!unit) return number;
  const whole = TOUCHING.includes(unit) && number.includes("±") ? `(${number})` : number;
  return TOUCHING.includes(unit) || unit.startsWith("″") ? `${whole}${unit}` : `${whole} ${unit}`;
}
