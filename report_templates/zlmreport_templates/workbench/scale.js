// From values to places on the screen, and round numbers for an axis.

/** Return the scale that takes `low` … `high` to `from` … `to`. */
export function scale(low, high, from, to) {
  const factor = (to - from) / (high - low || 1);
  const place = (value) => from + (value - low) * factor;
  place.value = (at) => low + (at - from) / factor;
  place.low = low;
  place.high = high;
  return place;
}

/** Return round values from `low` to `high`, about `count` of them. */
export function ticks(low, high, count) {
  const raw = (high - low) / Math.max(1, count) || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= raw * 0.999);
  const found = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + step * 1e-9; n += 1) found.push(Number((n * step).toPrecision(12)));
  return found;
}

/** Return the ends of values with some room, or those of a single value. */
export function extent(values, room = 0) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value === null || !Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  const more = (high - low || 1) * room;
  return [low - more, high + more];
}
