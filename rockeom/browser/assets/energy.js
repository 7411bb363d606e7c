"use strict";
// Bars of energy at the shown time: what was put in, what is there, and what was lost until then.

/** Rows of the bars: the place of each among the energies of a runner, its text and colour. */
const BARS = /** @type {const} */ ([
  [3, "putIn", "ink"],
  [0, "kinetic", "blue"],
  [1, "gravitational", "blue"],
  [2, "elastic", "blue"],
  [4, "lost", "orange"],
]);

class EnergyBars {
  /** @param {HTMLCanvasElement} canvas @param {Runner} runner */
  constructor(canvas, runner) {
    this.canvas = canvas;
    this.runner = runner;
    this.low = this.high = 0;
    this.factor = 1;
    this.unit = "";
    this.bars = [...BARS];
    if (runner.of.weight) by("energy-over").textContent = TEXTS.energyRatio;
  }

  /** Energy k at sample i. @param {number} k @param {number} i */
  at(k, i) {
    return this.runner.energies[k * SAMPLES + i];
  }

  /** The scale, which is that of the whole motion. */
  take() {
    const n = this.runner.shown;
    const rows = BARS.map(([k]) => this.runner.energies.subarray(k * SAMPLES, k * SAMPLES + n));
    this.low = Math.min(0, ...rows.map((row) => Math.min(...row)));
    this.high = Math.max(0, ...rows.map((row) => Math.max(...row)));
    this.bars = BARS.filter(([k], row) => k !== 2 || rows[row].some(Boolean));
    [this.factor, this.unit] = this.scale();
    const [putIn, lost] = [3, 4].map((k) => this.text(k, n - 1));
    this.canvas.setAttribute("aria-label", fill(TEXTS.energyOf, putIn, lost));
  }

  /** The energy that is shown as one, and its unit. @returns {[number, string]} */
  scale() {
    const { p, of } = this.runner;
    if (of.weight) {
      const places = this.runner.at(0);
      const [body, foot] = ["body", "foot"].map((kind) => 3 * of.kinds.indexOf(kind));
      const R = Math.hypot(places[body] - places[foot], places[body + 1] - places[foot + 1]);
      return [p[of.weight[0]] * p[of.weight[1]] * R, ""];
    }
    if (of.energyUnit !== "J") return [1, ""];
    const power = Math.min(Math.max(Math.floor(Math.log10(this.high || 1) / 3), 0), 3);
    return [1000 ** power, ["J", "kJ", "MJ", "GJ"][power]];
  }

  /** @param {number} k @param {number} i */
  text(k, i) {
    const size = Math.max(this.high, -this.low) || 1;
    const energy = this.at(k, i);
    const shown = Math.abs(energy) < 5e-4 * size ? 0 : energy / this.factor;
    return `${few(shown)} ${this.unit}`.trim();
  }

  /** @param {number} i */
  draw(i) {
    const { to, width, height, color } = pen(this.canvas);
    const room = height / this.bars.length;
    const [left, right] = [Math.min(0.38 * width, 180), width - 84];
    const scale = (right - left) / (this.high - this.low || 1);
    const zero = left - this.low * scale;
    this.bars.forEach(([k, name, shade], row) => {
      const middle = room * (row + 0.5);
      const bar = this.at(k, i) * scale;
      to.fillStyle = color(shade);
      to.fillRect(zero + Math.min(bar, 0), middle - 0.3 * room, Math.abs(bar), 0.6 * room);
      to.fillStyle = color("ink");
      write(to, TEXTS[name], left - 8, middle + 4, "right");
      write(to, this.text(k, i), width - 8, middle + 4, "right");
    });
    to.strokeStyle = color("ink");
    to.lineWidth = 1;
    line(to, [zero, 4], [zero, height - 4]);
  }
}
