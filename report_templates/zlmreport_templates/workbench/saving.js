// Saves what a graph shows: as a drawing, as a picture, as a table; made in the browser, sent nowhere.

const LOOKS = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "font-size", "text-anchor"];
const FACTOR = 3;

/** Save the drawing of a graph, its looks written into it. */
export function saveSvg(plot, name) {
  const copy = plot.svg.cloneNode(true);
  const [width, height] = size(plot);
  for (const [attribute, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", width, height })) copy.setAttribute(attribute, value);
  copy.removeAttribute("aria-hidden");
  const originals = plot.svg.querySelectorAll("*");
  copy.querySelectorAll("*").forEach((each, index) => {
    const look = getComputedStyle(originals[index]);
    for (const property of LOOKS) each.setAttribute(property, look.getPropertyValue(property));
    if (each.tagName === "text") each.setAttribute("font-family", look.fontFamily);
    each.removeAttribute("class");
  });
  save(new Blob([new XMLSerializer().serializeToString(copy)], { type: "image/svg+xml" }), `${name}.svg`);
}

/** Save a picture of a graph, on the paper of the page. */
export function savePng(plot, name) {
  const [width, height] = size(plot);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width * FACTOR, height * FACTOR];
  const pen = canvas.getContext("2d");
  pen.scale(FACTOR, FACTOR);
  pen.fillStyle = getComputedStyle(plot.element.closest("section") ?? document.body).backgroundColor;
  pen.fillRect(0, 0, width, height);
  paint(pen, plot.svg);
  canvas.toBlob((blob) => save(blob, `${name}.png`));
}

/** Save rows of values as CSV: a row of names, then numbers with a point. */
export function saveCsv(rows, name) {
  const cell = (value) => (/[",\n]/.test(String(value ?? "")) ? `"${String(value).replaceAll('"', '""')}"` : String(value ?? ""));
  save(new Blob([rows.map((row) => `${row.map(cell).join(",")}\n`).join("")], { type: "text/csv" }), `${name}.csv`);
}

function size(plot) {
  return [plot.element.clientWidth, plot.element.clientHeight];
}

function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

/** Paint the elements of a drawing as the page shows them: the policy of the page lets no drawing be loaded. */
function paint(pen, parent) {
  for (const element of parent.children) {
    if (element.tagName === "clipPath") continue;
    pen.save();
    const clip = element.getAttribute("clip-path")?.match(/#(.+)\)/)?.[1];
    if (clip) pen.clip(outline(document.getElementById(clip).firstElementChild));
    const look = getComputedStyle(element);
    if (element.tagName === "text") write(pen, element, look);
    else if (element.tagName !== "g") draw(pen, outline(element), look);
    paint(pen, element);
    pen.restore();
  }
}

function draw(pen, path, look) {
  if (look.fill !== "none") {
    pen.globalAlpha = Number(look.fillOpacity);
    pen.fillStyle = look.fill;
    pen.fill(path);
    pen.globalAlpha = 1;
  }
  if (look.stroke !== "none") {
    pen.strokeStyle = look.stroke;
    pen.lineWidth = parseFloat(look.strokeWidth);
    pen.setLineDash(look.strokeDasharray === "none" ? [] : look.strokeDasharray.split(",").map(parseFloat));
    pen.stroke(path);
  }
}

function write(pen, element, look) {
  pen.font = `${look.fontSize} ${look.fontFamily}`;
  pen.fillStyle = look.fill;
  pen.textAlign = { middle: "center", end: "right" }[look.textAnchor] ?? "left";
  pen.fillText(element.textContent, Number(element.getAttribute("x")), Number(element.getAttribute("y")));
}

function outline(element) {
  const at = (name) => Number(element.getAttribute(name) ?? 0);
  const path = new Path2D(element.tagName === "path" ? element.getAttribute("d") : "");
  if (element.tagName === "rect") path.rect(at("x"), at("y"), at("width"), at("height"));
  if (element.tagName === "circle") path.arc(at("cx"), at("cy"), at("r"), 0, 2 * Math.PI);
  if (element.tagName === "line") {
    path.moveTo(at("x1"), at("y1"));
    path.lineTo(at("x2"), at("y2"));
  }
  return path;
}
