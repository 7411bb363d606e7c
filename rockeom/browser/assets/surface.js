"use strict";
// Surfaces of bodies in space, and the geometry of points that are seen from above or in a picture.

/** @typedef {{place: number, vertices: number, faces: number, corners: number, at: number}} Solid */
/** Cosines of the angles between faces beyond which an edge is drawn; the second of many faces. */
const CREASES = [Math.cos(Math.PI / 6), Math.cos((70 * Math.PI) / 180)];
const MANY = 300;

/** The surface of a body: vertices from its centroid, faces, and edges with the two faces beside each. */
class Surface {
  /** @param {Solid} solid @param {Float64Array} vertices @param {Uint16Array} faces */
  constructor(solid, vertices, faces) {
    this.solid = solid;
    this.vertices = vertices;
    this.faces = Array.from({ length: solid.faces }, (_, f) =>
      Array.from(new Set(faces.subarray(f * solid.corners, (f + 1) * solid.corners))),
    );
    this.normals = this.faces.map(() => [0, 0, 0]);
    /** @type {Map<number, number[]>} */
    const beside = new Map();
    this.faces.forEach((face, f) =>
      face.forEach((a, i) => {
        const b = face[(i + 1) % face.length];
        const key = Math.min(a, b) * 65536 + Math.max(a, b);
        beside.set(key, [...(beside.get(key) ?? []), f]);
      }),
    );
    this.edges = Array.from(beside, ([key, of]) => ({
      ends: [Math.floor(key / 65536), key % 65536],
      of,
      sharp: true,
    }));
    /** @type {number[][]} */
    this.points = [];
  }

  /** Take the vertices, which sliders may have moved. */
  shape() {
    const v = this.vertices;
    this.points = Array.from({ length: v.length / 3 }, (_, i) => Array.from(v.subarray(3 * i, 3 * i + 3)));
    this.faces.forEach((face, f) => {
      const sum = [0, 0, 0];
      face.forEach((a, i) => {
        const b = face[(i + 1) % face.length];
        const [p, q] = [this.points[a], this.points[b]];
        for (let k = 0; k < 3; k++)
          sum[k] += p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
      });
      const length = Math.hypot(...sum) || 1;
      this.normals[f] = sum.map((x) => x / length);
    });
    const crease = CREASES[this.faces.length < MANY ? 0 : 1];
    for (const edge of this.edges) {
      const [a, b] = edge.of.map((f) => this.normals[f]);
      edge.sharp = !b || dot(a, b) < crease;
    }
  }
}

/** @param {number[]} a @param {number[]} b */
function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Begin a closed line. @param {CanvasRenderingContext2D} to @param {Point[]} points */
function outline(to, points) {
  to.beginPath();
  for (const [x, y] of points) to.lineTo(x, y);
  to.closePath();
}

/** Whether a face covers a point of the picture and is before it. @param {Drawn} face @param {Point} point @param {number} depth */
function covers({ points, depths }, [x, y], depth) {
  const inside = points.every(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) < 0; // the picture has y downwards
  });
  if (!inside) return false;
  // of the plane through its corners
  const [[ax, ay], [bx, by], [cx, cy]] = points;
  const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
  const b = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area;
  const c = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area;
  return depths[0] + b * (depths[1] - depths[0]) + c * (depths[2] - depths[0]) > depth;
}

/** The lowest vertices of a surface: its base. @param {number[][]} points */
function lowest(points) {
  const heights = points.map(([, , z]) => z);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  return points.filter(([, , z]) => z <= low + 1e-6 * (high - low));
}

/** Points seen from above that lie around all, counter-clockwise. @param {number[][]} points @returns {number[][]} */
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  /** @param {number[][]} along */
  const half = (along) => {
    /** @type {number[][]} */
    const found = [];
    for (const point of along) {
      for (let n = found.length; n > 1; n--) {
        const [a, b] = found.slice(-2);
        if ((b[0] - a[0]) * (point[1] - a[1]) > (b[1] - a[1]) * (point[0] - a[0])) break;
        found.pop();
      }
      found.push(point);
    }
    return found.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}
