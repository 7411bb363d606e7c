"use strict";
// What all views draw with: a pen, lines of many points, and axes with few round numbers.

/** A number in few digits. @param {number} x */
function few(x) {
  if (!Number.isFinite(x)) return String(x);
  const size = Math.abs(x);
  if (size === 0) return "0";
  return size >= 1e4 || size < 1e-3 ? x.toExponential(2) : String(Number(x.toPrecision(3)));
}

/** A number on an axis. @param {number} x */
function short(x) {
  const size = Math.abs(x);
  if (size < 1e5 && (size >= 1e-3 || size === 0)) return String(Number(x.toPrecision(3)));
  return Number(x.toPrecision(3)).toExponential().replace("e+", "e");
}

/** The value of largest size. @param {Float64Array} values */
function peak(values) {
  return values.reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a), 0);
}

/** @typedef {{to: CanvasRenderingContext2D, width: number, height: number, color: (name: string) => string}} Pen */

/** A clean canvas with a pixel for each of the screen's. @param {HTMLCanvasElement} canvas @returns {Pen} */
function pen(canvas) {
  const scale = window.devicePixelRatio || 1;
  const { width, height } = canvas.getBoundingClientRect();
  if (canvas.width !== Math.round(width * scale)) canvas.width = Math.round(width * scale);
  if (canvas.height !== Math.round(height * scale)) canvas.height = Math.round(height * scale);
  const to = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  to.setTransform(scale, 0, 0, scale, 0, 0);
  to.clearRect(0, 0, width, height);
  to.font = "12px system-ui, sans-serif";
  to.lineJoin = "round";
  to.lineWidth = 1;
  const style = getComputedStyle(document.documentElement);
  return { to, width, height, color: (name) => style.getPropertyValue(`--${name}`).trim() };
}

/** @param {CanvasRenderingContext2D} to @param {...number[]} points */
function line(to, ...points) {
  to.beginPath();
  for (const [x, y] of points) to.lineTo(x, y);
  to.stroke();
}

/** @param {CanvasRenderingContext2D} to @param {number} x @param {number} y @param {number} radius */
function disc(to, x, y, radius) {
  to.beginPath();
  to.arc(x, y, radius, 0, 2 * Math.PI);
}

/** @param {CanvasRenderingContext2D} to @param {string} text @param {number} x @param {number} y @param {CanvasTextAlign} align */
function write(to, text, x, y, align = "left") {
  to.textAlign = align;
  to.fillText(text, x, y);
}

/**
 * A foot: filled where it is on the ground, a pivot; a ring leaves it at an impact.
 * @param {CanvasRenderingContext2D} to @param {(name: string) => string} color @param {Point} at
 * @param {boolean} closed @param {number} flash @param {string} [shade] of what fills it
 */
function foot(to, color, [x, y], closed, flash, shade = closed ? "orange" : "paper") {
  to.lineWidth = 1.5;
  to.strokeStyle = color(closed ? "orange" : "ink");
  to.fillStyle = color(shade);
  disc(to, x, y, closed ? 5 : 3.5);
  to.fill();
  to.stroke();
  if (!closed || flash >= 1) return;
  to.globalAlpha = 1 - flash;
  to.lineWidth = 3;
  disc(to, x, y, 6 + 16 * flash);
  to.stroke();
  to.globalAlpha = 1;
}

/** A rectangle of a canvas with the ranges of its axes. */
class Axes {
  /**
   * @param {Pen} pen @param {[number, number, number, number]} box left, top, right, bottom
   * @param {[number, number]} across @param {[number, number]} up ranges
   */
  constructor({ to, color }, [left, top, right, bottom], across, up) {
    this.left = left;
    this.top = top;
    this.right = right;
    this.bottom = bottom;
    this.to = to;
    this.color = color;
    this.low = across[0];
    this.floor = up[0];
    this.perX = (right - left) / (across[1] - across[0]);
    this.perY = (bottom - top) / (up[1] - up[0]);
    this.across = across;
    this.up = up;
  }

  /** @param {number} value */
  x(value) {
    return this.left + (value - this.low) * this.perX;
  }

  /** @param {number} value */
  y(value) {
    return this.bottom - (value - this.floor) * this.perY;
  }

  /** Level lines with numbers to the left. @param {number[]} values */
  rows(values = ticks(this.up, (this.bottom - this.top) / 34)) {
    const { to, left, right } = this;
    to.strokeStyle = this.color("faint");
    to.fillStyle = this.color("ink");
    to.lineWidth = 1;
    for (const value of values) {
      const y = this.y(value);
      line(to, [left, y], [right, y]);
      write(to, short(value), left - 5, Math.min(y + 4, this.bottom), "right");
    }
    to.textAlign = "left";
  }

  /** Upright lines, with numbers below where there is a unit. @param {string} [unit] @param {number[]} values */
  columns(unit, values = ticks(this.across, (this.right - this.left) / 80)) {
    const { to, top, right, bottom } = this;
    to.strokeStyle = this.color("faint");
    to.fillStyle = this.color("ink");
    to.lineWidth = 1;
    values.forEach((value, k) => {
      const x = this.x(value);
      line(to, [x, top], [x, bottom]);
      if (unit === undefined) return;
      const text = `${short(value)} ${k === values.length - 1 ? unit : ""}`.trim();
      const half = to.measureText(text).width / 2;
      write(to, text, Math.min(x, right + 8 - half), bottom + 14, "center");
    });
    to.textAlign = "left";
  }

  /** Draw within the rectangle only. @param {() => void} draw */
  inside(draw) {
    const { to, left, top, right, bottom } = this;
    to.save();
    to.beginPath();
    to.rect(left, top, right - left, bottom - top);
    to.clip();
    draw();
    to.restore();
  }

  /** A line through points, without those within half a pixel of the one before. @param {Float64Array} xs @param {Float64Array} ys */
  curve(xs, ys) {
    const { to } = this;
    let [lastX, lastY] = [NaN, NaN];
    to.beginPath();
    for (let i = 0; i < ys.length; i++) {
      const [x, y] = [this.x(xs[i]), this.y(ys[i])];
      if (Math.abs(x - lastX) < 0.5 && Math.abs(y - lastY) < 0.5) continue;
      to.lineTo(x, y);
      [lastX, lastY] = [x, y];
    }
    to.stroke();
  }
}

/** The ends of a range, and its middle. @param {[number, number]} range */
function ends([low, high]) {
  return [low, (low + high) / 2, high];
}

/** Round numbers in a range, about n of them. @param {[number, number]} range @param {number} n */
function ticks([low, high], n) {
  const rough = (high - low) / Math.max(n, 1);
  const size = 10 ** Math.floor(Math.log10(rough));
  const step = size * ([1, 2, 5].find((k) => k * size >= rough) ?? 10);
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) found.push(Number((k * step).toPrecision(12)));
  return found;
}
