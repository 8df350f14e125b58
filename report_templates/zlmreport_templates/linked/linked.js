// The graphs of a certificate in which readings can be pointed at; it is readable without them, too.

import { fill, h } from "./dom.js";
import { Graphs } from "./graphs.js";
import { written } from "./number.js";
import { failures } from "./panels.js";

const place = document.getElementById("linked");
const { texts, graphs: values, failures: found } = JSON.parse(document.getElementById("linked-values").textContent);
const graphs = new Graphs(texts, written, null);
const list = h("div", {});
fill(list, failures(texts, { failures: found }, (axis, readings) => graphs.point(axis, readings)));
place.append(graphs.element, list);
place.hidden = false;
graphs.show(values);
