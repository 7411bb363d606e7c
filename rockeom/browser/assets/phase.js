"use strict";
// The phase portrait: the rate over the rotation, and the separatrix of free motion.

class Portrait {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    /** @type {any} that take it */
    this.charts = undefined;
  }

  describe() {
    const { of } = this.charts.runner;
    const [most, fastest] = [this.charts.rotation, this.charts.rate].map((values) => Math.abs(peak(values)));
    const rate = of.rotation + of.states.length / 2;
    const parts = [quantity(most, of.stateUnits[of.rotation]), quantity(fastest, of.stateUnits[rate])];
    this.canvas.setAttribute("aria-label", fill(TEXTS.phaseOf, ...parts));
  }

  /** Whether there is a separatrix: of one coordinate, whose overturning angles are known. */
  get separated() {
    return this.charts.known && this.charts.runner.of.states.length === 2;
  }

  /** Largest rotation and rate of the picture; of a motion that falls, only its part near the separatrix. */
  reach() {
    const { rotation, rate, runner } = this.charts;
    const [most, fastest] = [rotation, rate].map((values) => Math.abs(peak(values)) || 1);
    const angle = Math.max(...runner.angles);
    if (!this.separated || most < NEAR_OVERTURNING * angle) return [1.1 * most, 1.1 * fastest];
    const reached = Math.min(1.1 * Math.max(most, angle), FARTHEST_RATIO * angle);
    const near = rate.filter(
      (/** @type {number} */ _, /** @type {number} */ i) => Math.abs(rotation[i]) <= reached,
    );
    const separatrix = Math.abs(peak(runner.separatrix.subarray(runner.separatrix.length / 2)));
    return [reached, 1.1 * Math.max(Math.abs(peak(near)), separatrix)];
  }

  /** @param {number} i the sample that is marked */
  draw(i) {
    const paint = pen(this.canvas);
    const { to, width, height, color } = paint;
    const { rotation, rate, runner } = this.charts;
    const [most, fastest] = this.reach();
    const axes = new Axes(paint, [48, 22, width - 10, height - 20], [-most, most], [-fastest, fastest]);
    const { states, stateUnits } = runner.of;
    const j = runner.of.rotation;
    axes.rows();
    axes.columns("");
    to.fillStyle = color("ink");
    const names = [j + states.length / 2, j].map((k) => `${words(states[k])} [${stateUnits[k]}]`);
    write(to, names[0], 6, 14);
    write(to, names[1], width - 10, height - 24, "right");
    axes.inside(() => {
      if (this.separated) this.separatrix(axes);
      to.strokeStyle = color("blue");
      to.lineWidth = 1.3;
      axes.curve(rotation, rate);
      to.fillStyle = color("orange");
      disc(to, axes.x(rotation[i]), axes.y(rate[i]), 5);
      to.fill();
    });
  }

  /** @param {Axes} axes */
  separatrix(axes) {
    const { to } = axes;
    const { separatrix } = this.charts.runner;
    const half = separatrix.length / 4; // rotations to the left and right, then the rates there
    to.strokeStyle = to.fillStyle = axes.color("orange");
    to.setLineDash([6, 4]);
    to.lineWidth = 1.3;
    for (const from of [0, half]) {
      const rotations = separatrix.subarray(from, from + half);
      const rates = separatrix.subarray(2 * half + from, 3 * half + from);
      for (const side of [1, -1])
        axes.curve(
          rotations,
          Float64Array.from(rates, (x) => side * x),
        );
    }
    to.setLineDash([]);
    write(to, TEXTS.separatrix, axes.right - 6, axes.top + 14, "right");
  }
}
