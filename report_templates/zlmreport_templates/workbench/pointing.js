// What is done to a graph with mouse, fingers and keys: pointing at readings, looking closer, moving, a box.

const SHORTEST_DRAG = 6;
const FLAT = 18;
const STEP = 1.25;
const KEY_STEP = 2;

/** Return the listeners of a graph by the names of their events. */
export function pointing(plot) {
  const hand = new Hand(plot);
  return {
    pointerdown: (event) => hand.pressed(event), pointermove: (event) => hand.moved(event),
    pointerup: (event) => hand.released(event), pointercancel: (event) => hand.released(event, true),
    pointerleave: () => hand.left(), wheel: (event) => hand.wheeled(event),
    dblclick: () => plot.told.zoomed(null), keydown: (event) => hand.typed(event),
  };
}

class Hand {
  constructor(plot) {
    this.plot = plot;
    this.fingers = new Map();
  }

  #place(event) {
    const box = this.plot.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  pressed(event) {
    if (event.button !== 0 || !this.plot.data) return;
    this.plot.element.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, this.#place(event));
    this.from = this.fingers.size === 1 ? this.#place(event) : undefined;
    this.moves = event.shiftKey || this.plot.mode === "move";
    if (this.fingers.size === 2) this.plot.select();
  }

  moved(event) {
    const { plot } = this;
    if (!plot.data) return;
    const now = this.#place(event);
    const before = this.fingers.get(event.pointerId);
    if (before) this.fingers.set(event.pointerId, now);
    if (this.fingers.size === 2 && before) this.#pinched(event.pointerId, before, now);
    else if (this.from && this.moves) this.#shift(before, now);
    else if (this.from) plot.select(this.from, now);
    else if (!before) {
      plot.at = plot.nearest(now);
      plot.told.marked(plot.at);
    }
  }

  released(event, cancelled = false) {
    const { plot } = this;
    const place = this.#place(event);
    this.fingers.delete(event.pointerId);
    const { from } = this;
    this.from = undefined;
    if (!from || !plot.data) return;
    plot.select();
    if (cancelled) return;
    const [wide, high] = [Math.abs(place.x - from.x), Math.abs(place.y - from.y)];
    if (Math.max(wide, high) < SHORTEST_DRAG) {
      plot.at = plot.nearest(place);
      plot.told.pinned(plot.at);
      return;
    }
    if (this.moves) return;
    const box = { x: sorted(plot.x.value(from.x), plot.x.value(place.x)), y: sorted(plot.y.value(from.y), plot.y.value(place.y)) };
    if (plot.mode === "select") plot.told.boxed(plot.within(box));
    else if (wide >= SHORTEST_DRAG && !plot.data.labels) this.#look(box.x, high > FLAT ? box.y : null);
  }

  left() {
    if (this.fingers.size === 0 && this.plot.data) this.plot.told.marked(null);
  }

  wheeled(event) {
    const { plot } = this;
    if (!plot.data || !(event.ctrlKey || event.metaKey || plot.element.contains(document.activeElement))) return;
    event.preventDefault(); // a page that is only scrolled past stays as it is
    this.#closer(this.#place(event), event.deltaY < 0 ? 1 / STEP : STEP, event.shiftKey);
  }

  /** Look closer or from farther away, about a place on the screen; the deviation follows unless it is meant. */
  #closer(place, factor, isDeviation) {
    const { plot } = this;
    if (isDeviation) this.#look([plot.x.low, plot.x.high], about(plot.y, place.y, factor));
    else if (!plot.data.labels) this.#look(about(plot.x, place.x, factor), plot.data.span);
  }

  #pinched(moved, before, now) {
    const [other] = [...this.fingers].filter(([finger]) => finger !== moved).map(([, place]) => place);
    const distance = (place) => Math.max(1, Math.hypot(place.x - other.x, place.y - other.y));
    this.#closer({ x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 }, distance(before) / distance(now), false);
  }

  #shift(before, now) {
    const { plot } = this;
    if (plot.data.labels) return;
    const by = (axis, from, to) => axis.value(from) - axis.value(to);
    const [across, up] = [by(plot.x, before.x, now.x), by(plot.y, before.y, now.y)];
    this.#look([plot.x.low + across, plot.x.high + across], plot.data.span && [plot.y.low + up, plot.y.high + up]);
  }

  /** Have a range shown, no larger than all there is. */
  #look(x, span) {
    const [first, last] = this.plot.whole("x");
    const range = x[1] - x[0] >= last - first ? null : [Math.max(first, Math.min(x[0], last - (x[1] - x[0]))), Math.min(last, Math.max(x[1], first + (x[1] - x[0])))];
    this.plot.told.zoomed(range || span ? { x: range, y: span ?? null } : null);
  }

  typed(event) {
    const { plot } = this;
    if (!plot.data) return;
    const steps = { ArrowRight: 1, ArrowLeft: -1, PageDown: 10, PageUp: -10 };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key in steps) this.#step(steps[event.key]);
    else if (event.key === "ArrowUp" || event.key === "ArrowDown") this.#otherAtSamePlace(event.key === "ArrowUp");
    else if (event.key === "Home") this.#go(this.#order()[0]);
    else if (event.key === "End") this.#go(this.#order().at(-1));
    else if (event.key === "Enter" || event.key === " ") plot.told.pinned(plot.at);
    else if (event.key === "Escape") {
      plot.at = null;
      plot.told.pinned(null);
    } else if (event.key === "+" || event.key === "-") this.#closer(this.#focus(), event.key === "+" ? 1 / KEY_STEP : KEY_STEP, false);
    else return;
    event.preventDefault();
  }

  #focus() {
    const { plot } = this;
    const value = plot.at === null ? (plot.x.low + plot.x.high) / 2 : plot.data.x[plot.at];
    return { x: plot.x(value), y: 0 };
  }

  #order() {
    const { data } = this.plot;
    return [...data.x.keys()].filter((index) => data.x[index] !== null).sort((one, other) => data.x[one] - data.x[other] || data.y[one] - data.y[other]);
  }

  #step(by) {
    const { at } = this.plot;
    const order = this.#order();
    const now = at === null ? -Math.sign(by) : order.indexOf(at);
    this.#go(order[Math.max(0, Math.min(order.length - 1, at === null && by < 0 ? order.length - 1 : now + by))]);
  }

  #otherAtSamePlace(higher) {
    const { at, data: { x, y } } = this.plot;
    if (at === null) return;
    const beyond = [...x.keys()].filter((index) => x[index] === x[at] && (higher ? y[index] > y[at] : y[index] < y[at]));
    if (beyond.length) this.#go(beyond.reduce((best, index) => (Math.abs(y[index] - y[at]) < Math.abs(y[best] - y[at]) ? index : best)));
  }

  #go(index) {
    this.plot.at = index;
    this.plot.told.marked(index);
  }
}

function sorted(one, other) {
  return one < other ? [one, other] : [other, one];
}

/** Return what a scale shows when it is stretched by a factor about a place on the screen. */
function about(axis, place, factor) {
  const middle = axis.value(place);
  return [middle + (axis.low - middle) * factor, middle + (axis.high - middle) * factor];
}
