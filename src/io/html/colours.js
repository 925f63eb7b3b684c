// Colours of cells and vertices, and the legend that tells them.

// From bad, or least, to good, or most: light grows all the way, so that it reads without hues, too.
const SCALE = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
const MISSING = [170, 170, 170];
const BARS = 40;

/** Returns the colour of a place in the scale, from 0 to 1; grey for NaN. */
function colourAt(place) {
  if (Number.isNaN(place)) return MISSING;
  const at = Math.min(Math.max(place, 0), 1) * (SCALE.length - 1);
  const from = Math.min(Math.floor(at), SCALE.length - 2);
  return SCALE[from].map((x, channel) => x + (at - from) * (SCALE[from + 1][channel] - x));
}

function parsedColour(text) {
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16));
}

/** Returns a number with four digits. */
function figure(value) {
  if (Number.isNaN(value)) return "none";
  if (!Number.isFinite(value)) return String(value).replace("Infinity", "∞");
  return String(Number(value.toPrecision(4)));
}

/** Returns what cells can be coloured by: each with `of`, "cells", "vertices" or "facets", and the colour of one of
 *  these. */
function colourings(mesh) {
  const measures = mesh.measures.map((measure) => ({
    ...measure,
    place: (value) => (value - measure.bad) / (measure.good - measure.bad),
    value: (place) => measure.bad + place * (measure.good - measure.bad),
    told: (value) => figure(value) + (Number.isNaN(value) ? "" : measure.unit),
  }));
  const labels = mesh.labels.map((labels) => {
    const colours = new Map();
    labels.distinct.forEach((label, at) => colours.set(label, parsedColour(mesh.colours[at % mesh.colours.length])));
    return { ...labels, colours, told: String };
  });
  const attributes = mesh.attributes.map((attribute) => {
    const { name, least, most } = attribute;
    // Halves do not overflow.
    const value = (place) => 2 * (least / 2 + place * (most / 2 - least / 2));
    return { ...attribute, key: name, unit: "", of: "vertices", place: (x) => x, value, told: (x) => figure(value(x)) };
  });
  const plain = { name: "nothing", key: "plain", of: "cells", plain: parsedColour(mesh.plain) };
  return [...measures, ...labels, ...attributes, plain];
}

/** Returns the colour of a cell or vertex, or of a facet; grey for none. */
function colourOf(colouring, index) {
  if (colouring.plain) return colouring.plain;
  if (index < 0) return MISSING;
  const value = colouring.values[index];
  return colouring.colours ? colouring.colours.get(value) : colourAt(colouring.place(value));
}

/** Fills the legend of a colouring; `toggle` hides or shows the cells of a label. */
function fillLegend(legend, colouring, hidden, toggle) {
  legend.replaceChildren();
  if (colouring.plain) return;
  if (colouring.colours) {
    fillLabels(legend, colouring, hidden, toggle);
  } else {
    fillScale(legend, colouring);
  }
}

function fillLabels(legend, colouring, hidden, toggle) {
  const list = document.createElement("div");
  list.className = "labels";
  const counts = new Map();
  const things = colouring.of === "facets" ? "triangles" : "cells";
  for (const label of colouring.values) counts.set(label, (counts.get(label) ?? 0) + 1);
  for (const [label, colour] of colouring.colours) {
    const [row, box, swatch] = ["label", "input", "i"].map((name) => document.createElement(name));
    box.type = "checkbox";
    box.checked = !hidden.has(label);
    box.addEventListener("change", () => toggle(label));
    swatch.style.background = `rgb(${colour})`;
    row.append(box, swatch, `${colouring.name} ${label} (${counts.get(label) ?? 0} ${things})`);
    list.append(row);
  }
  legend.append(list);
  if (colouring.of !== "facets") return;
  const words = document.createElement("p");
  words.textContent = "grey: sides of cells that are in no facet";
  legend.append(words);
}

/** Draws bars of how many values there are over the scale of colours, with numbers below. */
function fillScale(legend, colouring) {
  const counts = new Array(BARS).fill(0);
  let [least, most, missing] = [Infinity, -Infinity, 0];
  for (const value of colouring.values) {
    const place = colouring.place(value);
    if (Number.isNaN(place)) {
      missing++;
      continue;
    }
    least = Math.min(least, value);
    most = Math.max(most, value);
    counts[Math.min(Math.max(Math.floor(place * BARS), 0), BARS - 1)]++;
  }
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [8 * BARS, 52];
  const context = canvas.getContext("2d");
  const highest = Math.max(...counts, 1);
  counts.forEach((count, bar) => {
    const height = count > 0 ? Math.max(1, (36 * count) / highest) : 0;
    context.fillStyle = "#8794a3";
    context.fillRect(8 * bar, 38 - height, 7, height);
    context.fillStyle = `rgb(${colourAt((bar + 0.5) / BARS).map(Math.round)})`;
    context.fillRect(8 * bar, 40, 8, 12);
  });
  const ticks = document.createElement("p");
  ticks.className = "ticks";
  for (const place of [0, 0.25, 0.5, 0.75, 1]) {
    const tick = document.createElement("span");
    // The first colour is that of all values beyond its end, too.
    const isBeyond = place === 0 && (colouring.place(least) < 0 || colouring.place(most) < 0);
    const sign = isBeyond ? (colouring.value(1) < colouring.value(0) ? "≥ " : "≤ ") : "";
    tick.textContent = sign + figure(colouring.value(place)) + (colouring.unit ?? "");
    ticks.append(tick);
  }
  const words = document.createElement("p");
  const range = least <= most ? `from ${colouring.told(least)} to ${colouring.told(most)}` : "no values";
  words.textContent = `${colouring.name}: ${range}${missing > 0 ? `; grey: ${missing} without a value` : ""}`;
  legend.append(canvas, ticks, words);
}
