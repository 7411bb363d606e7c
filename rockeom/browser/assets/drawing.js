"use strict";
// The structure drawn to scale, in axes that move with the ground, on a canvas.

/** @typedef {[number, number]} Point */

/** Part of the size of a structure below which a foot is on the ground. */
const ON_GROUND = 1e-6;

class Sketch {
  /** @param {HTMLCanvasElement} canvas @param {Runner} runner */
  constructor(canvas, runner) {
    this.canvas = canvas;
    this.runner = runner;
    this.size = 1;
    /** Height of the ground, below the bearings of a structure that has such. */
    this.level = 0;
  }

  /** Measure the structure at the start, so that the scale stays while it moves. */
  measure() {
    const { of, places } = this.runner;
    this.runner.at(0);
    let most = 0;
    for (let i = 0; i < of.positions.length; i++)
      most = Math.max(most, Math.abs(places[3 * i]), places[3 * i + 1]);
    for (const corners of this.outlines()) {
      for (const [x, y] of corners) most = Math.max(most, Math.abs(x), y);
    }
    for (let m = 0; m < of.members.length; m++) {
      if (of.members[m] === "column") this.level = Math.min(this.level, this.ends(m)[0][1]);
    }
    this.size = most - this.level || 1;
  }

  /** Outlines of the bodies, where they are now, with the copies of those that stand for several. */
  outlines() {
    const { of, corners } = this.runner;
    /** @type {Record<string, Point[]>} */
    const found = {};
    of.corners.forEach((/** @type {string} */ name, /** @type {number} */ i) => {
      (found[name] ??= []).push(this.point(name, corners[2 * i], corners[2 * i + 1]));
    });
    return Object.entries(found).flatMap(([name, outline]) =>
      this.shifts(name).map((shift) => outline.map(([x, y]) => /** @type {Point} */ ([x + shift, y]))),
    );
  }

  /** How far the copies of a body are from it. @param {string} name */
  shifts(name) {
    const { of, corners } = this.runner;
    const k = of.copies.indexOf(name);
    if (k < 0) return [0];
    const at = corners.length - 2 * (of.copies.length - k);
    const [number, apart] = [Math.round(corners[at]), corners[at + 1]];
    return Array.from({ length: number }, (_, i) => apart * (i - (number - 1) / 2));
  }

  /** A point of a body or of the ground. @param {string} name @param {number} dx @param {number} dy @returns {Point} */
  point(name, dx, dy) {
    const { of, places } = this.runner;
    const i = of.positions.indexOf(name);
    if (i < 0) return [dx, dy];
    const [x, y, angle] = [places[3 * i], places[3 * i + 1], places[3 * i + 2]];
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return [x + c * dx + s * dy, y - s * dx + c * dy];
  }

  /** Tell the largest rotation and how it ends. @param {string} text */
  describe(text) {
    this.canvas.setAttribute("aria-label", `${TEXTS.structure}. ${text}`);
  }

  /** Draw sample i; shift is the displacement of the ground in the picture. @param {number} i @param {number} shift */
  draw(i, shift) {
    const paint = pen(this.canvas);
    const { width, height } = paint;
    const scale = Math.min(width / 3, height / 1.25) / this.size;
    // what leaves the picture all the same comes back on the other side
    const away = ((((shift * scale) % width) + 1.5 * width) % width) - width / 2;
    this.ground(paint, height - 28, away);
    this.stand(paint, [width / 2 + away, height - 28 + this.level * scale], scale, i);
  }

  /** The ground, hatched; away is where its hatches begin. @param {Pen} paint @param {number} level @param {number} away */
  ground({ to, width, color }, level, away) {
    to.lineWidth = 1;
    to.strokeStyle = color("ink");
    to.beginPath();
    to.moveTo(0, level);
    to.lineTo(width, level);
    for (let x = (away % 18) - 18; x < width + 18; x += 18) {
      to.moveTo(x + 9, level);
      to.lineTo(x, level + 9);
    }
    to.stroke();
  }

  /** The structure at sample i, its origin at a place of the picture. @param {Pen} paint @param {Point} origin @param {number} scale @param {number} i */
  stand({ to, color }, [ox, oy], scale, i) {
    const { of } = this.runner;
    this.runner.at(i);
    /** @param {Point} point @returns {Point} */
    const on = ([x, y]) => [ox + x * scale, oy - y * scale];
    to.strokeStyle = color("blue");
    to.fillStyle = color("safe");
    to.lineWidth = 1.5;
    for (const outline of this.outlines()) {
      to.beginPath();
      outline.forEach((point) => to.lineTo(...on(point)));
      to.closePath();
      to.fill();
      to.stroke();
    }
    of.members.forEach((/** @type {string} */ kind, /** @type {number} */ m) => {
      const ends = this.ends(m);
      to.strokeStyle = color(kind === "tendon" ? "orange" : kind in SHAPES ? "ink" : "blue");
      member(to, this.state(kind, of.memberEnds[2 * m]), on(ends[0]), on(ends[1]), on(ends[2]));
    });
    to.strokeStyle = color("blue");
    to.lineWidth = 1.5;
    for (const [body, foot] of of.legs) line(to, on(this.place(body)), on(this.place(foot)));
    const flash = this.runner.flash(i);
    of.kinds.forEach((/** @type {string} */ kind, /** @type {number} */ k) => {
      const at = this.place(k);
      if (kind === "body") {
        to.fillStyle = color("blue");
        disc(to, ...on(at), of.corners.includes(of.positions[k]) ? 3.5 : 8);
        to.fill();
      } else if (kind === "push") {
        const tail = at[0] - 0.2 * this.size * Math.sign(this.runner.force(of.positions[k]) ?? 0);
        to.strokeStyle = color("orange");
        if (tail !== at[0]) member(to, "push", on([tail, at[1]]), on(at), on(at));
      } else if (kind === "end") {
        to.fillStyle = color("ink");
        to.fillRect(on(at)[0] - 8, on(at)[1] - 3, 16, 6);
      } else if (/^(foot|wall|spring)/.test(kind)) {
        for (const shift of this.shifts(of.copies[0] ?? "")) {
          foot(to, color, on([at[0] + shift, at[1]]), at[1] <= ON_GROUND * this.size, flash);
        }
      }
    });
  }

  /** The kind of a member, in the state of the element whose it is. @param {string} kind @param {string} name */
  state(kind, name) {
    const force = this.runner.force(name);
    if (kind !== "tendon" || force === undefined) return kind;
    return Number.isNaN(force) ? "broken" : force > 0 ? "tight" : "slack";
  }

  /** Where a body or a foot is. @param {number} k @returns {Point} */
  place(k) {
    const { places } = this.runner;
    return [places[3 * k], places[3 * k + 1]];
  }

  /** The ends of a member, and the place towards which it leaves its first one. @param {number} m @returns {Point[]} */
  ends(m) {
    const { of, corners } = this.runner;
    const first = of.corners.length + 2 * m;
    const [x, y, x2, y2] = corners.subarray(2 * first, 2 * first + 4);
    const [start, end] = of.memberEnds.slice(2 * m, 2 * m + 2);
    const from = this.point(start, x, y);
    const to = this.point(end, x2, y2);
    return [from, to, this.point(start, x, y + Math.hypot(to[0] - from[0], to[1] - from[1]) / 2)];
  }
}

/** Lines of members, of points one after the other: along the member, 0 to 1, and across it [px]. @type {Record<string, number[][]>} */
const SHAPES = {
  spring: [[0, 0, 0.15, 0, 0.2, -6, 0.3, 6, 0.4, -6, 0.5, 6, 0.6, -6, 0.7, 6, 0.8, -6, 0.85, 0, 1, 0]],
  damper: [
    [0, 0, 0.35, 0],
    [0.7, 6, 0.35, 6, 0.35, -6, 0.7, -6],
    [0.55, 4, 0.55, -4],
    [0.55, 0, 1, 0],
  ],
  push: [[0, 0, 1, 0, 0.8, -5, 1, 0, 0.8, 5]],
  broken: [
    [0, 0, 0.4, 0],
    [0.6, 0, 1, 0],
  ],
  wall: [[0, 0, 1, 0], ...Array.from({ length: 16 }, (_, k) => [(k + 1) / 16, 0, k / 16, -9])],
};

/** @param {CanvasRenderingContext2D} to @param {string} kind @param {Point} a @param {Point} b @param {Point} towards */
function member(to, kind, a, b, towards) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy) || 1;
  to.lineWidth = kind in SHAPES || kind === "tendon" || kind === "slack" ? 1.5 : 3;
  for (const shape of SHAPES[kind] ?? []) {
    to.beginPath();
    for (let k = 0; k < shape.length; k += 2) {
      const [x, y] = [shape[k], shape[k + 1] / length];
      to.lineTo(a[0] + x * dx - y * dy, a[1] + x * dy + y * dx);
    }
    to.stroke();
  }
  if (kind in SHAPES) return;
  to.setLineDash(kind === "tendon" || kind === "slack" ? [7, 3] : []);
  to.beginPath();
  to.moveTo(...a);
  if (kind === "cantilever") to.quadraticCurveTo(...towards, ...b);
  else to.lineTo(...b);
  to.stroke();
  to.setLineDash([]);
}

/** The views of the plane. @param {Explorer} page */
function inPlane(page) {
  page.sketch = new Sketch(by("structure"), page.runner);
  return new Charts(by("history"), new Portrait(by("phase")), page.runner);
}
