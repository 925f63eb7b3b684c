// What the page shows, what its controls change, and the fragment of its address that keeps it, such as
// #by=regions&cut=0.5&axis=z&turn=30,20.

const FEW_INPUTS = 5000;

function element(id) {
  return document.getElementById(id);
}

/** Returns the state of the page as its address has it, or as it suits the mesh. */
function initialState(mesh, colourings) {
  const given = new URLSearchParams(location.hash.slice(1));
  const pick = (name, known, other) => (known.includes(given.get(name)) ? given.get(name) : other);
  const number = (name, other) => {
    const value = Number.parseFloat(given.get(name));
    return Number.isFinite(value) ? value : other;
  };
  const flag = (name, other) => (given.has(name) ? given.get(name) !== "0" : other);
  const keys = colourings.map((colouring) => colouring.key);
  const several = mesh.labels.filter((labels) => labels.key === "regions" && labels.distinct.length > 1);
  const by = [...mesh.attributes.map((attribute) => attribute.name), ...several.map((labels) => labels.key)];
  // Around points of space are cells of which no input is a vertex; they would hide the others.
  const isCloud = mesh.dim === 3 && mesh.labels.every((labels) => labels.key !== "regions");
  const turn = (given.get("turn") ?? "").split(",").map(Number);
  const inputs = mesh.kinds.reduce((count, kind) => count + (kind === 0 ? 1 : 0), 0);
  return {
    by: pick("by", keys, by[0] ?? keys[0]),
    cells: pick("cells", ["all", "inputs"], isCloud && hasOthers(mesh) ? "inputs" : "all"),
    cut: Math.min(Math.max(number("cut", 1), 0), 1),
    axis: pick("axis", mesh.dim === 2 ? ["x", "y"] : ["x", "y", "z"], "x"),
    keep: pick("keep", ["below", "above"], "below"),
    edges: flag("edges", true),
    lines: flag("lines", true),
    dots: flag("dots", mesh.dim === 2 && inputs <= FEW_INPUTS),
    light: flag("light", true),
    turn: turn.length === 2 && turn.every(Number.isFinite) ? turn : [-60, 25],
    zoom: Math.max(number("zoom", 1), 1e-3),
    hidden: Object.fromEntries(mesh.labels.map((labels) => [labels.key, new Set()])),
  };
}

/** Returns true if some cells have an input as a vertex, and others have none. */
function hasOthers(mesh) {
  let [has, others] = [false, false];
  for (let cell = 0; cell < mesh.count && !(has && others); cell++) {
    if (isAtInput(mesh, cell)) has = true;
    else others = true;
  }
  return has && others;
}

class Viewer {
  constructor(mesh) {
    this.mesh = mesh;
    this.colourings = colourings(mesh);
    this.state = initialState(mesh, this.colourings);
    this.picture = new Picture(element("picture"), mesh);
    this.fillControls();
    this.choose();
    this.listen();
  }

  fillControls() {
    const { state, mesh } = this;
    for (const { key, name } of this.colourings) element("by").add(new Option(name, key));
    if (mesh.dim === 2) element("axis").options[2].remove();
    for (const name of ["by", "cells", "cut", "axis", "keep"]) element(name).value = state[name];
    for (const name of ["edges", "lines", "dots"]) element(name).checked = state[name];
    element("lines").parentElement.hidden = mesh.segments === 0;
    const turns = mesh.dim === 2 ? "Dragging moves" : "Dragging turns, the right button moves";
    element("hint").textContent = `${turns}, the wheel zooms. The address keeps what is shown.`;
  }

  /** Chooses cells anew, and looks at all of them. */
  choose() {
    this.wanted = wantedCells(this.mesh, this.state);
    this.ranges = [0, 1, 2].map((axis) => rangeOf(this.mesh, this.wanted, axis));
    if (this.mesh.dim === 2) this.ranges[2] = [0, 0];
    this.update();
    this.picture.look(this.ranges, this.state.turn, this.state.zoom);
  }

  /** Shows the chosen cells on one side of the plane. */
  update() {
    const { mesh, state, picture } = this;
    this.colouring = this.colourings.find((colouring) => colouring.key === state.by);
    const range = this.ranges["xyz".indexOf(state.axis)];
    this.shown = cutCells(mesh, this.wanted, state, range);
    this.faces = visibleFaces(mesh, this.shown, state);
    picture.showFaces(this.faces, this.colouring);
    picture.faces.material.uniforms.edges.value = state.edges ? 1 : 0;
    picture.faces.material.uniforms.light.value = state.light && mesh.dim === 3 ? 1 : 0;
    this.showMarks();
    const toggle = (label) => this.toggle(label);
    fillLegend(element("legend"), this.colouring, state.hidden[state.by] ?? new Set(), toggle);
    this.tell(range);
    picture.draw();
  }

  /** Shows segments and inputs that shown cells have. */
  showMarks() {
    const { mesh, state, picture } = this;
    const isThere = new Uint8Array(mesh.vertices);
    for (let cell = 0; cell < mesh.count; cell++) {
      if (this.shown[cell]) for (const vertex of verticesOf(mesh, cell)) isThere[vertex] = 1;
    }
    const [lines, dots] = [[], []];
    for (let at = 0; state.lines && at < mesh.ends.length; at += 2) {
      const [from, to] = [mesh.ends[at], mesh.ends[at + 1]];
      if (isThere[from] && isThere[to]) lines.push(from, to);
    }
    for (let vertex = 0; state.dots && vertex < mesh.vertices; vertex++) {
      if (isThere[vertex] && mesh.kinds[vertex] === 0) dots.push(vertex, vertex);
    }
    picture.showMarks(picture.lines, lines);
    picture.showMarks(picture.dots, dots);
  }

  /** Tells how many cells are shown, and where the plane is. */
  tell([least, most]) {
    const { mesh, state } = this;
    let count = 0;
    for (let cell = 0; cell < mesh.cells; cell++) count += this.shown[cell];
    const names = mesh.dim === 2 ? "triangles" : "tetrahedra";
    const told = (number) => number.toLocaleString("en").replaceAll(",", "\u00a0");
    const axis = "xyz".indexOf(state.axis);
    const place = mesh.center[axis] + (least + state.cut * (most - least)) * mesh.half;
    const cut = `${state.axis} = ${figure(place)}`;
    const where = this.shown === this.wanted ? "" : `; cut at ${cut}, what is ${state.keep} is kept`;
    const which = state.cells === "inputs" ? " with an input as a vertex" : "";
    element("shown").textContent = `Shown: ${told(count)} of ${told(mesh.all)} ${names}${which}${where}`;
  }

  toggle(label) {
    const hidden = this.state.hidden[this.state.by];
    if (!hidden.delete(label)) hidden.add(label);
    this.wanted = wantedCells(this.mesh, this.state);
    this.update();
  }

  listen() {
    const on = (id, event, act) => element(id).addEventListener(event, act);
    for (const name of ["by", "axis", "keep"]) on(name, "change", () => this.set(name, element(name).value));
    on("cut", "input", () => this.set("cut", Number(element("cut").value)));
    for (const name of ["edges", "lines", "dots"]) on(name, "change", () => this.set(name, element(name).checked));
    on("cells", "change", () => {
      this.state.cells = element("cells").value;
      this.keep();
      this.choose();
    });
    on("whole", "click", () => this.picture.look(this.ranges, [-60, 25], 1));
    window.addEventListener("hashchange", () => location.reload());
    let start = null;
    on("picture", "pointerdown", (event) => (start = [event.clientX, event.clientY]));
    on("picture", "pointerup", (event) => {
      const isClick = start && Math.hypot(event.clientX - start[0], event.clientY - start[1]) < 4;
      if (isClick) this.pick(event.offsetX, event.offsetY);
    });
  }

  set(name, value) {
    this.state[name] = value;
    this.keep();
    this.update();
  }

  /** Keeps what is shown in the address, where the browser lets a file do so. */
  keep() {
    const { by, cells, cut, axis, keep, edges, lines, dots } = this.state;
    const flags = { edges: Number(edges), lines: Number(lines), dots: Number(dots) };
    const words = new URLSearchParams({ by, cells, cut, axis, keep, ...flags });
    try {
      history.replaceState(null, "", `#${words}`);
    } catch {
      // The page works without it.
    }
  }

  /** Tells the figures of the cell under a place of the picture. */
  pick(x, y) {
    const { mesh } = this;
    const face = this.picture.faceAt(this.faces, x, y);
    if (face < 0) return;
    const cell = this.faces.cells[face];
    const vertices = [...verticesOf(mesh, cell)];
    const number = cell < mesh.cells ? Math.floor((cell * mesh.all) / mesh.cells) : null;
    const lines = [number === null ? "Triangle of a cell that was left out" : `Cell ${number}`];
    const facet = this.faces.facets[face];
    const places = { cells: [cell], vertices, facets: facet < 0 ? [] : [facet] };
    for (const { name, of, values, told, plain } of this.colourings) {
      if (plain || places[of].length === 0) continue;
      lines.push(`${name}: ${places[of].map((place) => told(values[place])).join(", ")}`);
    }
    for (const vertex of vertices) {
      const place = [0, 1, 2].slice(0, mesh.dim).map((axis) => mesh.center[axis] + mesh.points[3 * vertex + axis] * mesh.half);
      lines.push(`${["input", "Steiner", "cage"][mesh.kinds[vertex]]} at (${place.map(figure).join(", ")})`);
    }
    element("picked").textContent = lines.join("\n");
  }
}

/** Begins, or says why it cannot. */
function begin() {
  const file = decodeURIComponent(location.pathname.split("/").pop());
  if (file) element("name").textContent = document.title = file;
  try {
    window.viewer = new Viewer(readMesh(element("mesh").textContent));
  } catch (error) {
    const fault = element("fault");
    fault.hidden = false;
    fault.textContent = `No picture: ${error.message}. It needs a browser with WebGL 2; the figures beside it do not.`;
    throw error;
  }
}

begin();
