"use strict";
// Seen from above: the tilt of a body against the direction to which it leans, and the ways of its feet.

/** The texts of pages of space, which Python puts among the others. */
const WORDS = /** @type {typeof TEXTS & typeof TEXTS.space} */ (TEXTS);
/** Directions at which the stability surface is drawn, and places on the ways of all feet. */
const DIRECTIONS = 180;
const WAYS = 4800;
/** Relative difference of distances that is rounding. */
const LEVEL = 1e-9;

/** The lean of the body at all samples of a motion, and the tilts at which it overturns. */
class Lean {
  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    this.tilt = this.ratio = new Float64Array(0);
    /** Cosine and sine of the direction along the axes of the body. */
    this.towards = [this.tilt, this.tilt];
    /** Tilts at which it overturns, by direction, empty where none is known. @type {number[][]} */
    this.arms = [];
  }

  /** Take the motion of the runner. */
  take() {
    const { runner, surfaces, leans } = this.scene;
    for (const surface of surfaces) surface.shape();
    this.scene.leaned();
    const [, , , x, y, z, bx, by] = Array.from({ length: 8 }, (_, k) =>
      leans.subarray(k * SAMPLES, k * SAMPLES + runner.shown),
    );
    this.tilt = z.map((up, i) => Math.atan2(Math.hypot(x[i], y[i]), up));
    const size = bx.map((_, i) => Math.hypot(bx[i], by[i]) || 1);
    this.towards = [bx, by].map((along) => along.map((at, i) => -at / size[i]));
    this.arms = this.scene.arms();
    this.ratio = this.tilt.map((tilt, i) => tilt / this.barrier(this.towards[0][i], this.towards[1][i]));
  }

  get known() {
    return this.arms.length > 0;
  }

  /** The tilt from which it does not come back: the centroid is highest, above one of its feet. @param {number} c @param {number} s cosine and sine of the direction */
  barrier(c, s) {
    if (this.scene.runner.of.space.round)
      return Math.atan(Math.max(...this.arms.map(([x, y, z]) => Math.hypot(x, y) / -z)));
    const below = this.arms.filter(([, , z]) => z < 0);
    const slopes = below.map(([x, y, z]) => (x * c + y * s) / -z);
    const far = below.map(([, , z], i) => (slopes[i] > 0 ? Math.hypot(z, z * slopes[i]) : 0));
    const most = Math.max(...far) * (1 - LEVEL);
    return Math.atan(Math.max(...slopes.filter((_, i) => far[i] >= most)));
  }
}

/** The tilt against its direction along the axes of the body, and the stability surface. */
class LeanPlot {
  /** @param {HTMLCanvasElement} canvas @param {Lean} lean */
  constructor(canvas, lean) {
    this.canvas = canvas;
    this.lean = lean;
    /** @type {number[][]} */
    this.surface = [];
  }

  describe() {
    const { lean } = this;
    this.surface = Array.from({ length: lean.known ? DIRECTIONS + 1 : 0 }, (_, k) => {
      const [c, s] = [Math.cos, Math.sin].map((f) => f((2 * Math.PI * k) / DIRECTIONS));
      return [c, s].map((x) => x * lean.barrier(c, s));
    });
    const tilts = this.surface.map((at) => Math.hypot(...at));
    const parts = [peak(lean.tilt), Math.min(...tilts), Math.max(...tilts)].map((x) => quantity(x, "rad"));
    this.canvas.setAttribute("aria-label", fill(lean.known ? WORDS.leanOf : WORDS.leanAlone, ...parts));
  }

  /** @param {number} i the sample that is marked */
  draw(i) {
    const paint = pen(this.canvas);
    const { to, width, height, color } = paint;
    const { tilt, towards } = this.lean;
    const [most, largest] = [peak(tilt) || 1e-3, Math.max(0, ...this.surface.map((at) => Math.hypot(...at)))];
    const near = largest > 0 && most > NEAR_OVERTURNING * largest;
    const reach = near
      ? Math.max(1.08 * largest, Math.min(1.05 * most, FARTHEST_RATIO * largest))
      : 1.1 * most;
    const [x, y, radius] = [width / 2, height / 2, Math.min(width, height) / 2 - 16];
    /** @param {number[]} at @returns {Point} */
    const on = ([a, b]) => [x + (a / reach) * radius, y - (b / reach) * radius];
    to.strokeStyle = color("faint");
    to.fillStyle = color("ink");
    for (const ring of ticks([0, reach / DEGREE], 3).slice(1)) {
      disc(to, x, y, (ring * DEGREE * radius) / reach);
      to.stroke();
      write(to, `${short(ring)}°`, x + 3, y - (ring * DEGREE * radius) / reach - 2);
    }
    line(to, [x - radius, y], [x + radius, y]);
    line(to, [x, y - radius], [x, y + radius]);
    write(to, "x", x + radius + 4, y + 4);
    write(to, "y", x, y - radius - 4, "center");
    to.save();
    disc(to, x, y, radius);
    to.clip();
    to.strokeStyle = color("orange");
    to.setLineDash([6, 4]);
    to.lineWidth = 1.4;
    line(to, ...this.surface.map(on));
    to.setLineDash([]);
    to.strokeStyle = color("blue");
    const ways = Array.from(tilt, (t, k) => on([t * towards[0][k], t * towards[1][k]]));
    line(to, ...ways);
    to.fillStyle = color("orange");
    disc(to, ...ways[i], 5);
    to.fill();
    to.restore();
  }
}

/** The base from above: where its feet were on the ground, at the start dashed, and now. */
class Plan {
  /** @param {HTMLCanvasElement} canvas @param {Scene} scene */
  constructor(canvas, scene) {
    this.canvas = canvas;
    this.scene = scene;
    /** @type {number[][]} */
    this.first = [];
    /** Ways of feet on the ground: places, null between two of them. @type {(number[] | null)[][]} */
    this.ways = [];
    this.low = [0, 0];
    this.high = [1, 1];
  }

  take() {
    const { scene } = this;
    const { runner } = scene;
    const last = runner.shown - 1;
    const step = Math.ceil((runner.shown * runner.of.space.feet.length) / WAYS);
    this.ways = [];
    const [first, ...others] = [0, last].map((i) => {
      scene.at(i);
      return scene.base();
    });
    this.first = first;
    const around = [...first, ...others.flat()];
    for (let i = 0; i <= last; i += step) {
      scene.at(i);
      scene.feet().forEach(({ at, work }, k) => (this.ways[k] ??= []).push(work === "open" ? null : at));
    }
    for (const at of this.ways.flat()) if (at) around.push(at);
    this.low = [0, 1].map((k) => around.reduce((least, at) => Math.min(least, at[k]), Infinity));
    this.high = [0, 1].map((k) => around.reduce((most, at) => Math.max(most, at[k]), -Infinity));
    const sides = this.high.map((high, k) => quantity(high - this.low[k], "m"));
    this.canvas.setAttribute("aria-label", fill(WORDS.planOf, ...sides));
  }

  /** @param {number} i */
  draw(i) {
    const paint = pen(this.canvas);
    const { to, width, height, color } = paint;
    const { low, high, scene } = this;
    const perMetre = 0.8 * Math.min(width / (high[0] - low[0]), (height - 20) / (high[1] - low[1]));
    const half = [width - 54, height - 30].map((pixels) => pixels / perMetre / 2);
    const middle = low.map((x, k) => (x + high[k]) / 2);
    const ranges = middle.map((x, k) => /** @type {[number, number]} */ ([x - half[k], x + half[k]]));
    const axes = new Axes(paint, [44, 10, width - 10, height - 20], ranges[0], ranges[1]);
    axes.rows();
    axes.columns("m", ticks(axes.across, 3));
    /** @param {number[]} at @returns {Point} */
    const on = ([x, y]) => [axes.x(x), axes.y(y)];
    axes.inside(() => {
      to.strokeStyle = to.fillStyle = color("orange");
      to.lineWidth = 2.5;
      to.lineCap = "round";
      for (const way of this.ways) {
        to.beginPath();
        way.forEach((at, k) => {
          if (!at) return;
          if (!way[k - 1]) to.moveTo(...on(at));
          to.lineTo(...on(at));
        });
        to.stroke();
      }
      scene.at(i);
      to.lineWidth = 1.4;
      for (const [base, dash, shade] of [
        [this.first, [5, 4], "ink"],
        [scene.base(), [], "blue"],
      ]) {
        to.setLineDash(/** @type {number[]} */ (dash));
        to.strokeStyle = color(/** @type {string} */ (shade));
        outline(to, /** @type {number[][]} */ (base).map(on));
        to.stroke();
      }
      to.setLineDash([]);
    });
  }
}

/** Charts in which the tilt of the body takes the place of a rotation, with its plan. */
class ChartsInSpace extends Charts {
  /** @param {Scene} scene @param {HTMLCanvasElement} plan */
  constructor(scene, plan) {
    const lean = new Lean(scene);
    super(by("history"), new LeanPlot(by("phase"), lean), scene.runner);
    this.lean = lean;
    this.plan = new Plan(plan, scene);
    this.name = WORDS.tilt;
    this.usual = "tilt";
    this.menu.options[0].text = fill(TEXTS.ratio, WORDS.tilt);
    this.menu.add(new Option(WORDS.tilt, "tilt"), 1);
  }

  turn() {
    this.lean.take();
    [this.rotation, this.ratio, this.known] = [this.lean.tilt, this.lean.ratio, this.lean.known];
    this.plan.take();
  }

  choose() {
    super.choose();
    this.low = isNaN(Number(this.menu.value)) ? 0 : -1;
  }

  /** On a narrow screen one label is below the other. @param {Pen} paint @param {number} left @param {number} y */
  tell({ to, width }, left, y) {
    let x = left;
    for (const label of this.groundLabels()) {
      const room = to.measureText(label).width + 12;
      if (x > left && x + room > width) [x, y] = [left, y + 14];
      write(to, label, x, y);
      x += room;
    }
  }

  /** @param {string} place @returns {[any, string]} */
  quantity(place) {
    return place === "tilt" ? [this.rotation, "rad"] : super.quantity(place);
  }

  /** @param {number} i */
  draw(i) {
    super.draw(i);
    this.plan.draw(this.sample);
  }
}

/** The views of a structure in space. @param {Explorer} page */
function inSpace(page) {
  const figure = document.createElement("figure");
  const plan = document.createElement("canvas");
  const caption = Object.assign(document.createElement("figcaption"), { textContent: WORDS.planCaption });
  plan.setAttribute("role", "img");
  plan.style.height = "15rem";
  figure.append(plan, caption);
  by("plane").before(figure);
  page.sketch = new Scene(by("structure"), page.runner, () => page.redraw());
  return new ChartsInSpace(page.sketch, plan);
}
