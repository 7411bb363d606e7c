"use strict";
// The charts of one motion: a state and the ground over time, and those of phase.js and energy.js.

/** The part of the overturning angle from which its limits are in the picture. */
const NEAR_OVERTURNING = 0.2;
const FARTHEST_RATIO = 1.5;

class Charts {
  /** @param {HTMLCanvasElement} history @param {any} portrait @param {Runner} runner */
  constructor(history, portrait, runner) {
    this.history = history;
    this.runner = runner;
    this.portrait = portrait;
    portrait.charts = this;
    this.bars = new EnergyBars(by("energy"), runner);
    this.times = this.rotation = this.rate = this.ratio = this.chosen = new Float64Array(0);
    this.sample = 0;
    /** Whether the overturning angles are known. */
    this.known = false;
    this.isRatio = false;
    this.unit = "";
    this.most = 0;
    /** -1, or 0 where the upper curve has no other side. */
    this.low = -1;
    /** What turns, and its place in the menu. */
    const { states, rotation } = runner.of;
    this.name = words(states[rotation]);
    this.usual = String(rotation);
    /** The ground along its axes. @type {Float64Array[]} */
    this.shaking = [];
    /** @type {number[]} */
    this.mostShaking = [];
    this.menu = by("quantity");
    this.makeMenu();
  }

  /** The menu of the upper curve: the rotation over the overturning angle, and all states. */
  makeMenu() {
    const { of } = this.runner;
    const names = of.states.map((/** @type {string} */ name) => words(name));
    this.menu.add(new Option(fill(TEXTS.ratio, this.name), "ratio"));
    names.forEach((/** @type {string} */ name, /** @type {number} */ j) =>
      this.menu.add(new Option(name, String(j))),
    );
    this.menu.addEventListener("change", () => {
      this.choose();
      this.draw(this.sample);
    });
  }

  /** Take the curves of a motion, which stay while time goes on. */
  take() {
    this.runner.accounted();
    this.times = Float64Array.from({ length: this.runner.shown }, (_, i) => i * this.runner.spacing[0]);
    this.turn();
    this.choose();
    this.portrait.describe();
    this.bars.take();
  }

  /** Take the rotation, and the angles at which it overturns. */
  turn() {
    const { of, angles } = this.runner;
    this.runner.balance?.();
    this.rotation = this.column(of.rotation);
    this.rate = this.column(of.rotation + of.states.length / 2);
    this.known = angles[0] > 0 && angles[1] > 0;
    this.ratio = this.rotation.map((x) => x / (x < 0 ? angles[0] : angles[1]));
  }

  /** A state at all samples. @param {number} j */
  column(j) {
    const { states, of } = this.runner;
    return this.times.map((_, i) => states[i * of.states.length + j]);
  }

  /** Take the curve that the menu names. */
  choose() {
    const { of, ground, shown } = this.runner;
    this.menu.options[0].hidden = this.menu.options[0].disabled = !this.known;
    if (!this.known && this.menu.value === "ratio") this.menu.value = this.usual;
    this.isRatio = this.menu.value === "ratio";
    [this.chosen, this.unit] = this.isRatio ? [this.ratio, "-"] : this.quantity(this.menu.value);
    this.most = Math.abs(peak(this.chosen));
    this.shaking = of.ground.map((/** @type {string} */ _, /** @type {number} */ k) =>
      ground.subarray(k * SAMPLES, k * SAMPLES + shown),
    );
    this.mostShaking = this.shaking.map((values) => Math.abs(peak(values)));
    this.history.setAttribute("aria-label", `${this.label()}. ${this.groundLabels().join("; ")}.`);
  }

  /** A quantity of the menu and its unit. @param {string} place @returns {[any, string]} */
  quantity(place) {
    return [this.column(Number(place)), this.runner.of.stateUnits[place]];
  }

  label() {
    return fill(TEXTS.peakOf, this.menu.selectedOptions[0].text, quantity(this.most, this.unit));
  }

  /** What there is to say of the ground along each axis, of the others than the first where it moves. */
  groundLabels() {
    const { groundUnit, ground } = this.runner.of;
    const texts = /** @type {Record<string, any>} */ (TEXTS);
    return this.mostShaking.flatMap((most, k) =>
      most || !k ? fill(TEXTS.peakOf, texts[ground[k]], quantity(most, groundUnit)) : [],
    );
  }

  /** @param {Pen} paint @param {number} x @param {number} y */
  tell({ to }, x, y) {
    write(to, this.groundLabels().join("; "), x, y);
  }

  /** Draw all; sample i is marked. @param {number} i */
  draw(i) {
    this.sample = Math.min(i, this.runner.shown - 1);
    this.overTime(this.sample);
    this.portrait.draw(this.sample);
    this.bars.draw(this.sample);
  }

  /** The chosen curve, and the ground below it. @param {number} i */
  overTime(i) {
    const { spacing } = this.runner;
    const paint = pen(this.history);
    const { to, width, height, color } = paint;
    const [left, right, middle] = [48, width - 10, 0.6 * (height - 20)];
    /** @type {[number, number]} */
    const across = [0, this.runner.end];
    const limited = this.isRatio && this.most > NEAR_OVERTURNING;
    const most = limited ? Math.min(Math.max(this.most, 1.04), FARTHEST_RATIO) : this.most || 1;
    const upper = new Axes(paint, [left, 20, right, middle], across, [1.12 * most * this.low, 1.12 * most]);
    upper.rows(limited ? [this.low, 0, 1] : undefined);
    upper.columns();
    if (limited) this.limits(upper);
    to.strokeStyle = color("blue");
    to.lineWidth = 1.6;
    upper.inside(() => upper.curve(this.times, this.chosen));
    this.impacts(upper);
    const shaken = Math.max(...this.mostShaking) || 1;
    const lower = new Axes(paint, [left, middle + 22, right, height - 20], across, [-shaken, shaken]);
    lower.rows(ends(lower.up));
    lower.columns(this.runner.of.groundUnit === "-" ? "" : "s");
    to.strokeStyle = color("orange");
    to.lineWidth = 1.4;
    this.shaking.forEach((along, k) => {
      const vertical = k === this.shaking.length - 1;
      to.setLineDash(vertical ? [4, 3] : k ? [2, 3] : []);
      to.strokeStyle = color(vertical ? "ink" : k ? "blue" : "orange");
      if (!k || this.mostShaking[k]) lower.curve(this.times, along);
    });
    to.setLineDash([]);
    to.fillStyle = color("blue");
    write(to, this.label(), left, 14);
    to.fillStyle = color("orange");
    this.tell(paint, left, middle + 17);
    to.strokeStyle = color("ink");
    to.lineWidth = 1;
    const now = upper.x(i * spacing[0]);
    line(to, [now, 20], [now, height - 20]);
  }

  /** The overturning angles. @param {Axes} axes */
  limits(axes) {
    const { to } = axes;
    to.strokeStyle = to.fillStyle = axes.color("orange");
    to.setLineDash([6, 4]);
    for (const side of [this.low || 1, 1]) line(to, [axes.left, axes.y(side)], [axes.right, axes.y(side)]);
    to.setLineDash([]);
    write(to, TEXTS.limit, axes.right - 4, axes.y(1) + 14, "right");
  }

  /** Ticks at the impacts. @param {Axes} axes */
  impacts(axes) {
    const { impacts, spacing } = this.runner;
    axes.to.strokeStyle = axes.color("ink");
    let last = -1;
    for (let k = 0; k < spacing[2]; k++) {
      const x = axes.x(impacts[k]);
      if (x < last + 2) continue;
      line(axes.to, [x, axes.bottom], [x, axes.bottom - 5]);
      last = x;
    }
  }
}
