"use strict";

// The mesh of the page, which of its cells are chosen, and the faces of these that are to be seen.
// Cells are the simplices, and after them the outer triangles of tetrahedra that were left out.

// Corners of the side opposite each vertex of a tetrahedron, counterclockwise as seen from outside.
const SIDES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
// Exchanges that sort three numbers.
const SWAPS = [[0, 1], [1, 2], [0, 1]];

/** Returns the numbers of an array that is base64. */
function decoded(text, Numbers) {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let at = 0; at < bytes.length; at++) bytes[at] = characters.charCodeAt(at);
  return new Numbers(bytes.buffer);
}

/** Returns the mesh that the page has as JSON, with its arrays as numbers. */
function readMesh(text) {
  const mesh = JSON.parse(text);
  mesh.points = decoded(mesh.points, Float32Array);
  mesh.kinds = decoded(mesh.kinds, Uint8Array);
  for (const name of ["simplices", "skin", "ends", "facets"]) mesh[name] = decoded(mesh[name], Uint32Array);
  for (const measure of mesh.measures) measure.values = decoded(measure.values, Float32Array);
  for (const labels of mesh.labels) labels.values = decoded(labels.values, Int32Array);
  for (const attribute of mesh.attributes) attribute.values = decoded(attribute.values, Float32Array);
  mesh.size = mesh.dim + 1;
  mesh.count = mesh.cells + mesh.triangles;
  mesh.facetTable = mesh.facets.length > 0 ? facetTable(mesh.facets) : null;
  mesh.neighbors = mesh.dim === 3 ? neighborsOf(mesh.simplices) : null;
  return mesh;
}

/** Returns the vertices of a cell. */
function verticesOf(mesh, cell) {
  if (cell < mesh.cells) return mesh.simplices.subarray(cell * mesh.size, (cell + 1) * mesh.size);
  return mesh.skin.subarray(3 * (cell - mesh.cells), 3 * (cell - mesh.cells) + 3);
}

/** Returns a table with room for triangles by their vertices, which are in `corners`, those of each ascending. */
function emptyTable(corners) {
  let bits = 4;
  while (2 ** bits < (2 * corners.length) / 3) bits++;
  return { bits, corners, slots: new Int32Array(2 ** bits).fill(-1) };
}

/** Returns the place in a table where the number of a triangle is, or where it belongs if -1 is there. */
function slotOf({ bits, corners, slots }, a, b, c) {
  // Of a product the upper digits are those that depend on all of the factor.
  const mixed = Math.imul(Math.imul(Math.imul(a, 0x9e3779b1) + b, 0x85ebca6b) + c, 0xc2b2ae35);
  let slot = mixed >>> (32 - bits);
  for (; slots[slot] >= 0; slot = (slot + 1) & (slots.length - 1)) {
    const at = 3 * slots[slot];
    if (corners[at] === a && corners[at + 1] === b && corners[at + 2] === c) break;
  }
  return slot;
}

/** Returns, for each side of each tetrahedron, the tetrahedron beyond it, or -1: two tetrahedra are neighbours if
 *  they have a side in common, which a table of sides finds. */
function neighborsOf(tetrahedra) {
  const sides = sortedSides(tetrahedra);
  const table = emptyTable(sides);
  const neighbors = new Int32Array(tetrahedra.length).fill(-1);
  for (let side = 0; side < neighbors.length; side++) {
    const slot = slotOf(table, sides[3 * side], sides[3 * side + 1], sides[3 * side + 2]);
    const other = table.slots[slot];
    if (other < 0) {
      table.slots[slot] = side;
      continue;
    }
    neighbors[side] = other >> 2;
    neighbors[other] = side >> 2;
  }
  return neighbors;
}

/** Returns the vertices of all sides, those of each ascending. */
function sortedSides(tetrahedra) {
  const sides = new Uint32Array(3 * tetrahedra.length);
  for (let side = 0; side < tetrahedra.length; side++) {
    const first = side - (side & 3);
    let at = 3 * side;
    for (let corner = 0; corner < 4; corner++) if (corner !== (side & 3)) sides[at++] = tetrahedra[first + corner];
  }
  return sorted(sides);
}

/** Sorts the vertices of each triangle, and returns them. */
function sorted(triangles) {
  for (let at = 0; at < triangles.length; at += 3) {
    for (const [from, to] of SWAPS) {
      const [low, high] = [triangles[at + from], triangles[at + to]];
      if (low <= high) continue;
      triangles[at + from] = high;
      triangles[at + to] = low;
    }
  }
  return triangles;
}

/** Returns the table of the triangles of facets. */
function facetTable(facets) {
  const table = emptyTable(sorted(facets.slice()));
  const { corners, slots } = table;
  for (let at = 0; at < corners.length; at += 3) {
    slots[slotOf(table, corners[at], corners[at + 1], corners[at + 2])] = at / 3;
  }
  return table;
}

/** Returns the number of the facet's triangle with three vertices, or -1. */
function facetOf(mesh, ...triangle) {
  return mesh.facetTable ? mesh.facetTable.slots[slotOf(mesh.facetTable, ...sorted(triangle))] : -1;
}

/** Returns true if a vertex of the cell is an input. */
function isAtInput(mesh, cell) {
  return verticesOf(mesh, cell).some((vertex) => mesh.kinds[vertex] === 0);
}

/** Returns the coordinate of a cell's centroid. */
function middleOf(mesh, cell, axis) {
  const vertices = verticesOf(mesh, cell);
  let sum = 0;
  for (const vertex of vertices) sum += mesh.points[3 * vertex + axis];
  return sum / vertices.length;
}

/** Returns which cells pass the choice of cells and of labels, before they are cut. */
function wantedCells(mesh, state) {
  const wanted = new Uint8Array(mesh.count).fill(1);
  for (const labels of mesh.labels) {
    const hidden = state.hidden[labels.key];
    if (hidden.size === 0 || labels.of !== "cells") continue;
    for (let cell = 0; cell < mesh.count; cell++) if (hidden.has(labels.values[cell])) wanted[cell] = 0;
  }
  if (state.cells === "inputs") {
    for (let cell = 0; cell < mesh.count; cell++) if (!isAtInput(mesh, cell)) wanted[cell] = 0;
  }
  return wanted;
}

/** Returns the least and the largest coordinate of the wanted cells. */
function rangeOf(mesh, wanted, axis) {
  let [least, most] = [Infinity, -Infinity];
  for (let cell = 0; cell < mesh.count; cell++) {
    if (!wanted[cell]) continue;
    for (const vertex of verticesOf(mesh, cell)) {
      const x = mesh.points[3 * vertex + axis];
      if (x < least) least = x;
      if (x > most) most = x;
    }
  }
  return least < most ? [least, most] : [-1, 1];
}

/** Returns the wanted cells whose centroid is on the side of the plane that is kept. */
function cutCells(mesh, wanted, state, range) {
  const axis = "xyz".indexOf(state.axis);
  const [least, most] = range;
  const place = least + state.cut * (most - least);
  // At the ends of the slider nothing is cut off.
  if (state.keep === "below" ? state.cut >= 1 : state.cut <= 0) return wanted;
  const shown = new Uint8Array(mesh.count);
  for (let cell = 0; cell < mesh.count; cell++) {
    if (!wanted[cell]) continue;
    const isBelow = middleOf(mesh, cell, axis) <= place;
    shown[cell] = isBelow === (state.keep === "below") ? 1 : 0;
  }
  return shown;
}

/** Visits the sides of shown cells that no shown cell is beyond: a cell, and three vertices. */
function visitFaces(mesh, shown, visit) {
  const { simplices, skin, cells, neighbors } = mesh;
  for (let cell = 0; cell < cells; cell++) {
    if (!shown[cell]) continue;
    const at = cell * mesh.size;
    if (neighbors === null) {
      visit(cell, simplices[at], simplices[at + 1], simplices[at + 2]);
      continue;
    }
    for (let side = 0; side < 4; side++) {
      const beyond = neighbors[at + side];
      if (beyond >= 0 && shown[beyond]) continue;
      const [a, b, c] = SIDES[side];
      visit(cell, simplices[at + a], simplices[at + b], simplices[at + c]);
    }
  }
  for (let at = 0; at < skin.length; at += 3) {
    const cell = cells + at / 3;
    if (shown[cell]) visit(cell, skin[at], skin[at + 1], skin[at + 2]);
  }
}

/** Returns the faces that are to be seen: their cells, three vertices and the triangle of a facet, or -1, of each. */
function visibleFaces(mesh, shown, state) {
  const markers = mesh.labels.find((labels) => labels.of === "facets");
  const hidden = state.hidden.markers ?? new Set();
  const visit = (act) =>
    visitFaces(mesh, shown, (cell, ...vertices) => {
      const facet = facetOf(mesh, ...vertices);
      if (facet < 0 || !hidden.has(markers.values[facet])) act(cell, facet, vertices);
    });
  let count = 0;
  visit(() => count++);
  const [cells, vertices, facets] = [new Uint32Array(count), new Uint32Array(3 * count), new Int32Array(count)];
  let at = 0;
  visit((cell, facet, corners) => {
    cells[at] = cell;
    facets[at] = facet;
    vertices.set(corners, 3 * at++);
  });
  return { count, cells, vertices, facets };
}
