"use strict";
// Curves over time, and the rate over the rotation, with the place of the time that is shown.

/** A number in few digits. @param {number} x */
function few(x) {
  if (!Number.isFinite(x)) return String(x);
  const size = Math.abs(x);
  if (size === 0) return "0";
  return size >= 1e4 || size < 1e-3 ? x.toExponential(2) : String(Number(x.toPrecision(3)));
}

class Charts {
  /** @param {HTMLCanvasElement} history @param {HTMLCanvasElement} phase @param {Runner} runner */
  constructor(history, phase, runner) {
    this.history = history;
    this.phase = phase;
    this.runner = runner;
    /** @type {number[]} */
    this.rotation = [];
    /** @type {number[]} */
    this.rate = [];
    /** @type {number[]} */
    this.shaking = [];
  }

  /** Take the curves of a motion, which stay while time goes on. */
  take() {
    const { of, ground } = this.runner;
    this.rotation = this.column(of.rotation);
    this.rate = this.column(of.rotation + of.states.length / 2);
    this.shaking = Array.from(ground);
  }

  /** A state at all samples. @param {number} j */
  column(j) {
    const { states, of } = this.runner;
    const n = of.states.length;
    return Array.from({ length: this.shown() }, (_, i) => states[i * n + j]);
  }

  /** How many samples the motion has. */
  shown() {
    return Math.max(2, Math.round(this.runner.spacing[1]));
  }

  /** Draw both; sample i is marked. @param {number} i */
  draw(i) {
    const { of, spacing } = this.runner;
    const { rotation, rate, shaking } = this;
    const end = spacing[0] * (SAMPLES - 1);
    const name = of.states[of.rotation];
    const unit = of.stateUnits[of.rotation];
    this.curves(this.history, end, i, [
      {
        values: rotation,
        color: "blue",
        label: `${name} [${unit}], at most ${few(Math.abs(peak(rotation)))}`,
      },
      { values: shaking, color: "orange", label: `ground [m/s²], at most ${few(Math.abs(peak(shaking)))}` },
    ]);
    this.portrait(rotation, rate, i);
  }

  /**
   * @param {HTMLCanvasElement} canvas @param {number} end @param {number} i
   * @param {{values: number[], color: string, label: string}[]} curves
   */
  curves(canvas, end, i, curves) {
    const { to, width, height, color } = pen(canvas);
    const room = (height - 18) / curves.length;
    to.font = "12px system-ui, sans-serif";
    curves.forEach(({ values, color: of, label }, k) => {
      const [middle, half] = [room * (k + 0.56), 0.38 * room];
      const most = Math.abs(peak(values)) || 1;
      to.strokeStyle = color("faint");
      line(to, [
        [0, middle],
        [width, middle],
      ]);
      to.strokeStyle = color(of);
      to.lineWidth = 1.4;
      line(
        to,
        values.map((v, n) => [(n * width) / (SAMPLES - 1), middle - (half * v) / most]),
      );
      to.fillStyle = color(of);
      to.fillText(label, 6, room * k + 13);
    });
    const x = (i * width) / (SAMPLES - 1);
    to.strokeStyle = color("ink");
    to.lineWidth = 1;
    line(to, [
      [x, 0],
      [x, height],
    ]);
    to.fillStyle = color("ink");
    to.fillText("0 s", 4, height - 4);
    const text = `${few(end)} s`;
    to.fillText(text, width - to.measureText(text).width - 4, height - 4);
  }

  /** @param {number[]} rotation @param {number[]} rate @param {number} i */
  portrait(rotation, rate, i) {
    const { to, width, height, color } = pen(this.phase);
    const [mx, my] = [1.1 * Math.abs(peak(rotation)) || 1, 1.1 * Math.abs(peak(rate)) || 1];
    /** @param {number} k @returns {[number, number]} */
    const on = (k) => [(width * (1 + rotation[k] / mx)) / 2, (height * (1 - rate[k] / my)) / 2];
    to.strokeStyle = color("faint");
    line(to, [
      [0, height / 2],
      [width, height / 2],
    ]);
    line(to, [
      [width / 2, 0],
      [width / 2, height],
    ]);
    to.strokeStyle = color("blue");
    line(
      to,
      rotation.map((_, k) => on(k)),
    );
    const now = on(Math.min(i, rotation.length - 1));
    to.fillStyle = color("orange");
    to.beginPath();
    to.arc(now[0], now[1], 5, 0, 7);
    to.fill();
  }
}

/** The value of largest size. @param {number[]} values */
function peak(values) {
  return values.reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a), 0);
}

/** @param {CanvasRenderingContext2D} to @param {number[][]} points */
function line(to, points) {
  to.beginPath();
  points.forEach(([x, y], k) => (k ? to.lineTo(x, y) : to.moveTo(x, y)));
  to.stroke();
}
