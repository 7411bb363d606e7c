"use strict";
// The structure drawn to scale, in axes that move with the ground, on a canvas.

/** A canvas with a pixel for each of the screen's. @param {HTMLCanvasElement} canvas */
function pen(canvas) {
  const scale = window.devicePixelRatio || 1;
  const { width, height } = canvas.getBoundingClientRect();
  if (canvas.width !== Math.round(width * scale)) canvas.width = Math.round(width * scale);
  if (canvas.height !== Math.round(height * scale)) canvas.height = Math.round(height * scale);
  const to = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  to.setTransform(scale, 0, 0, scale, 0, 0);
  to.clearRect(0, 0, width, height);
  const style = getComputedStyle(document.documentElement);
  /** @param {string} name */
  const color = (name) => style.getPropertyValue(`--${name}`).trim();
  return { to, width, height, color };
}

class Sketch {
  /** @param {HTMLCanvasElement} canvas @param {Runner} runner */
  constructor(canvas, runner) {
    this.canvas = canvas;
    this.runner = runner;
    this.size = 1;
  }

  /** Measure the structure upright, so that the scale stays while it moves. */
  measure() {
    const { of, places } = this.runner;
    this.runner.at(0);
    let most = 0;
    const bodies = this.outlines();
    for (let i = 0; i < of.positions.length; i++)
      most = Math.max(most, Math.abs(places[3 * i]), places[3 * i + 1]);
    for (const corners of Object.values(bodies)) {
      for (const [x, y] of corners) most = Math.max(most, Math.abs(x), y);
    }
    this.size = most || 1;
  }

  /** Corners of the bodies, where they are now, by name. */
  outlines() {
    const { of, places, corners } = this.runner;
    /** @type {Record<string, [number, number][]>} */
    const found = {};
    of.corners.forEach((/** @type {string} */ name, /** @type {number} */ i) => {
      (found[name] ??= []).push(this.point(name, corners[2 * i], corners[2 * i + 1]));
    });
    return found;
  }

  /** A point of a body or of the ground. @param {string} name @param {number} dx @param {number} dy */
  point(name, dx, dy) {
    const { of, places } = this.runner;
    const i = of.positions.indexOf(name);
    if (i < 0) return /** @type {[number, number]} */ ([dx, dy]);
    const [x, y, angle] = [places[3 * i], places[3 * i + 1], places[3 * i + 2]];
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return /** @type {[number, number]} */ ([x + c * dx + s * dy, y - s * dx + c * dy]);
  }

  /** Draw sample i; shift is the displacement of the ground in the picture. @param {number} i @param {number} shift */
  draw(i, shift) {
    const { to, width, height, color } = pen(this.canvas);
    const { of, places, corners } = this.runner;
    this.runner.at(i);
    const scale = Math.min(width / 3, height / 1.25) / this.size;
    // a pulse leaves the ground moving on: what leaves the picture comes back on the other side
    const away = ((((shift * scale) % width) + 1.5 * width) % width) - width / 2;
    const [ox, oy] = [width / 2 + away, height - 28];
    /** @param {[number, number]} point */
    const on = ([x, y]) => /** @type {[number, number]} */ ([ox + x * scale, oy - y * scale]);
    to.lineWidth = 1;
    to.strokeStyle = color("ink");
    to.beginPath();
    to.moveTo(0, oy);
    to.lineTo(width, oy);
    for (let x = (away % 18) - 18; x < width; x += 18) {
      to.moveTo(x + 9, oy);
      to.lineTo(x, oy + 9);
    }
    to.stroke();
    to.strokeStyle = color("blue");
    to.fillStyle = color("safe");
    for (const outline of Object.values(this.outlines())) {
      to.lineWidth = 1.5;
      to.beginPath();
      outline.forEach((point, k) => (k ? to.lineTo(...on(point)) : to.moveTo(...on(point))));
      to.closePath();
      to.fill();
      to.stroke();
    }
    of.members.forEach((/** @type {string} */ kind, /** @type {number} */ m) => {
      const first = of.corners.length + 2 * m;
      const ends = [0, 1].map((k) =>
        this.point(of.memberEnds[2 * m + k], corners[2 * (first + k)], corners[2 * (first + k) + 1]),
      );
      to.lineWidth = kind === "spring" || kind === "damper" || kind === "tendon" ? 1.5 : 3;
      to.beginPath();
      to.moveTo(...on(ends[0]));
      to.lineTo(...on(ends[1]));
      to.stroke();
    });
    of.kinds.forEach((/** @type {string} */ kind, /** @type {number} */ k) => {
      const at = on([places[3 * k], places[3 * k + 1]]);
      if (kind === "load" || kind === "massless") return;
      to.fillStyle = kind === "body" ? color("blue") : color("ink");
      to.beginPath();
      to.arc(at[0], at[1], kind === "body" && !of.corners.includes(of.positions[k]) ? 8 : 3.5, 0, 7);
      to.fill();
    });
  }
}
