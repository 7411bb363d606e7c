"use strict";
// A structure in space on a canvas, its faces from the farthest to the nearest, in axes that move with the ground.

/** The direction of the light: to the right, upwards and towards the viewer. */
const LAMP = [-0.45, 0.65, 0.6];
/** Numbers of a place: x, y, z and the rotation. */
const PLACE = 12;
/** A face that looks less at the viewer is not seen. */
const EDGE_ON = 1e-9;
/** What a foot does, by its digit in the number of a mode: others slide. */
const WORKS = ["open", "bears", "idle", "bears"];

/** @typedef {{far: number, points: Point[], depths: number[], fill: string}} Drawn */

class Scene {
  /** @param {HTMLCanvasElement} canvas @param {Runner} runner @param {() => void} changed */
  constructor(canvas, runner, changed) {
    this.canvas = canvas;
    this.runner = runner;
    this.orbit = new Orbit(canvas, changed);
    this.size = 1;
    /** The middle of the picture, and half the width of the ground. */
    this.middle = [0, 0, 0];
    this.reach = 1;
    /** Whether the ground moves in the picture: where its way is short. */
    this.shakes = false;
    this.surfaces = this.made();
    /** The sample that is shown. */
    this.now = 0;
    /** Displacement of the ground along y. */
    this.across = new Float64Array(SAMPLES);
    const { program, states, modes, p, spacing } = runner;
    /** The place of the body, its axis, and the vertical along its own x and y, at all samples. */
    this.leans = program.floats([8, SAMPLES]);
    this.leaned = program.bind("leans", { states, modes, p, spacing, out: this.leans });
    canvas.style.height = "24rem";
  }

  /** The surfaces: those that depend on sliders are among the numbers of a motion. @returns {Surface[]} */
  made() {
    const { space, surfaces } = this.runner.of;
    let [floats, wholes] = [0, 0];
    for (const { at, vertices } of space.solids) wholes += at < 0 ? 12 * vertices : 0;
    return space.solids.map((/** @type {Solid} */ solid) => {
      const { at, vertices: n, faces: m, corners } = solid;
      const own = at < 0 && Float64Array.from(new Float32Array(surfaces, floats, 3 * n));
      const faces = new Uint16Array(surfaces, wholes, m * corners);
      floats += own ? 12 * n : 0;
      wholes += 2 * m * corners;
      return new Surface(solid, own || this.runner.numbers.subarray(at, at + 3 * n), faces);
    });
  }

  // --- the structure

  /** Measure the motion, so that all of it is in the picture. @param {Explorer} page */
  measure(page) {
    const { runner, surfaces } = this;
    this.across = page.displacement(1);
    this.at(0);
    const center = this.place(runner.of.space.body);
    const arms = [
      ...surfaces.flatMap(({ solid, points }) => points.map((point) => this.moved(solid.place, point))),
      ...this.feet().map(({ at }) => at),
    ].map((at) => at.map((x, k) => x - center[k]));
    const radius = arms.reduce((most, arm) => Math.max(most, Math.hypot(...arm)), 0) || 1;
    const ranges = [0, 1, 2].map((k) => {
      const along = this.leans.subarray(k * SAMPLES, k * SAMPLES + runner.shown);
      return [along.reduce((a, b) => Math.min(a, b)), along.reduce((a, b) => Math.max(a, b))];
    });
    const spread = Math.max(...ranges.slice(0, 2).map(([low, high]) => high - low)) / 2;
    this.middle = ranges.map(([low, high]) => (low + high) / 2);
    this.middle[2] *= 0.9; // there is more to see below: the ground
    this.size = radius + spread;
    this.reach = 1.3 * (0.7 * radius + spread);
    this.shakes = [page.moved, this.across].every((way) => Math.abs(peak(way)) < 0.4 * this.size);
  }

  /** Take the places at a sample. @param {number} i */
  at(i) {
    this.now = i;
    this.runner.at(i);
  }

  /** @param {number} k @returns {number[]} */
  place(k) {
    return Array.from(this.runner.places.subarray(PLACE * k, PLACE * k + 3));
  }

  /** Feet and points of contact: where they are and what they do. @returns {{at: number[], work: string}[]} */
  feet() {
    const { of, modes } = this.runner;
    const mode = Number(modes[this.now]);
    return of.space.feet.map((/** @type {number} */ place, /** @type {number} */ i) => {
      const at = this.place(place);
      const work = of.space.digits ? (WORKS[(mode >> (3 * i)) & 7] ?? "slides") : "bears";
      return { at, work };
    });
  }

  /** Places of the base from the centroid of the body, along its axes; none where its feet are not level. */
  arms() {
    const { body } = this.runner.of.space;
    this.at(0);
    const center = this.place(body);
    const feet = this.feet().map(({ at }) =>
      this.along(
        body,
        at.map((x, k) => x - center[k]),
      ),
    );
    if (feet.length < 3) return lowest(this.surfaces.find(({ solid }) => solid.place === body)?.points ?? []);
    return lowest(feet).length > 2 ? feet : [];
  }

  /** The base of the body seen from above, around it. */
  base() {
    const feet = this.feet();
    if (feet.length > 2) return hull(feet.map(({ at }) => at));
    const { body } = this.runner.of.space;
    const [surface] = this.surfaces.filter(({ solid }) => solid.place === body);
    return surface ? hull(lowest(surface.points).map((point) => this.moved(body, point))) : [];
  }

  /** Where a point of a body is. @param {number} body @param {number[]} point */
  moved(body, [x, y, z]) {
    const p = this.runner.places.subarray(PLACE * body, PLACE * (body + 1));
    return [0, 1, 2].map((k) => p[k] + p[3 + 3 * k] * x + p[4 + 3 * k] * y + p[5 + 3 * k] * z);
  }

  /** A direction along the axes of a body. @param {number} body @param {number[]} way */
  along(body, way) {
    const r = this.runner.places.subarray(PLACE * body + 3, PLACE * (body + 1));
    return [0, 1, 2].map((k) => way[0] * r[k] + way[1] * r[3 + k] + way[2] * r[6 + k]);
  }

  /** Tell the largest tilt and how it ends. @param {string} text */
  describe(text) {
    this.canvas.setAttribute("aria-label", `${/** @type {any} */ (TEXTS).structure} ${text}`);
  }

  // --- the picture

  /** Draw sample i; the ground is displaced in the picture. @param {number} i @param {number} x */
  draw(i, x) {
    const paint = pen(this.canvas);
    const { to, width, height, color } = paint;
    const [right, up, towards] = this.orbit.directions();
    const scale = (this.orbit.zoom * 0.43 * Math.min(width / 1.15, height)) / this.size;
    const shift = this.shakes ? [x, this.across[i], 0] : [0, 0, 0];
    const from = this.middle.map((at, k) => at - shift[k]);
    /** @param {number[]} point @returns {Point} */
    const on = (point) => {
      const [a, b, c] = point.map((at, k) => at - from[k]);
      return [
        width / 2 + scale * (right[0] * a + right[1] * b),
        height / 2 - scale * (up[0] * a + up[1] * b + up[2] * c),
      ];
    };
    this.at(i);
    this.floor(paint, on);
    const front = this.faces(paint, on, [right, up, towards]);
    if (!this.surfaces.length) this.frame(paint, on);
    const flash = this.runner.flash(i);
    for (const { at, work } of this.feet()) {
      const depth = dot(at, towards) + 1e-6 * this.size;
      const hidden = front.some((face) => covers(face, on(at), depth));
      to.globalAlpha = hidden ? 0.35 : 1;
      const fill = { bears: "orange", slides: "blue" }[/** @type {string} */ (work)] ?? "paper";
      foot(to, color, on(at), work !== "open", hidden ? 1 : flash, fill);
    }
    to.globalAlpha = 1;
  }

  /** The ground with a grid, its axes, and the shadows straight below the bodies. @param {Pen} paint @param {(point: number[]) => Point} on */
  floor({ to, color }, on) {
    const { middle, reach } = this;
    const [x, y] = middle;
    const low = [x - reach, y - reach];
    const high = [x + reach, y + reach];
    to.strokeStyle = color("faint");
    outline(
      to,
      [low, [high[0], low[1]], high, [low[0], high[1]]].map((at) => on([...at, 0])),
    );
    to.stroke();
    for (const value of ticks([low[0], high[0]], 4))
      line(to, on([value, low[1], 0]), on([value, high[1], 0]));
    for (const value of ticks([low[1], high[1]], 4))
      line(to, on([low[0], value, 0]), on([high[0], value, 0]));
    to.fillStyle = color("faint");
    for (const { solid, points } of this.surfaces) {
      const shadow = hull(points.map((point) => this.moved(solid.place, point)));
      outline(
        to,
        shadow.map(([a, b]) => on([a, b, 0])),
      );
      to.fill();
    }
    to.fillStyle = to.strokeStyle = color("ink");
    const corner = [low[0], low[1], 0];
    ["x", "y"].forEach((name, k) => {
      const tip = corner.map((at, j) => at + (j === k ? 0.35 * reach : 0));
      line(to, on(corner), on(tip));
      write(to, name, ...on(tip.map((at, j) => at + (j === k ? 0.08 * reach : 0))), "center");
    });
    const [, step] = ticks([0, 2 * reach], 4);
    write(to, fill(/** @type {any} */ (TEXTS).grid, short(step)), 8, 16);
  }

  /** Faces that look at the viewer and their edges, the nearest last. @param {Pen} paint @param {(point: number[]) => Point} on @param {number[][]} axes */
  faces({ to, color }, on, [right, up, towards]) {
    /** @type {Drawn[]} */
    const drawn = [];
    const ink = color("ink");
    const lamp = right.map((_, k) => LAMP[0] * right[k] + LAMP[1] * up[k] + LAMP[2] * towards[k]);
    const body = [1, 3, 5].map((k) => parseInt(color("safe").slice(k, k + 2), 16));
    for (const { solid, faces, normals, edges, points: at } of this.surfaces) {
      const places = at.map((point) => this.moved(solid.place, point));
      const points = places.map(on);
      const depths = places.map((place) => dot(place, towards));
      const [own, light] = [towards, lamp].map((way) => this.along(solid.place, way));
      const fars = faces.map((face, f) => {
        if (dot(normals[f], own) <= EDGE_ON) return -Infinity;
        const far = face.reduce((sum, i) => sum + depths[i], 0) / face.length;
        const shade = 0.72 + 0.28 * Math.max(dot(normals[f], light), 0);
        const fill = `rgb(${body.map((x) => Math.round(x * shade)).join(" ")})`;
        drawn.push({ far, points: face.map((i) => points[i]), depths: face.map((i) => depths[i]), fill });
        return far;
      });
      for (const { ends, of, sharp } of edges) {
        const far = Math.max(...of.map((f) => fars[f]));
        const drawnToo = sharp || of.some((f) => fars[f] === -Infinity);
        if (far > -Infinity && drawnToo)
          drawn.push({ far, points: ends.map((i) => points[i]), depths, fill: "" });
      }
    }
    drawn.sort((a, b) => a.far - b.far);
    to.lineWidth = 1;
    for (const { points, fill } of drawn) {
      outline(to, points);
      to.strokeStyle = fill || ink;
      to.fillStyle = fill;
      if (fill) to.fill();
      to.stroke();
    }
    return drawn.filter(({ fill }) => fill);
  }

  /** A body of no known shape: the plate between its feet, its legs and its centroid. @param {Pen} paint @param {(point: number[]) => Point} on */
  frame({ to, color }, on) {
    const { legs } = this.runner.of;
    to.strokeStyle = to.fillStyle = color("blue");
    to.lineWidth = 2;
    for (const [body, foot] of legs) line(to, on(this.place(body)), on(this.place(foot)));
    outline(to, hull(this.feet().map(({ at }) => at)).map(on));
    to.stroke();
    disc(to, ...on(this.place(this.runner.of.space.body)), 8);
    to.fill();
  }
}
