"use strict";
// Three sizes of the structure side by side, to one scale, under the same ground motion.

const SIZES = [1, 2, 4];

class Sizes {
  /**
   * @param {Sketch} sketch of the page, the first of the three @param {WebAssembly.Module} module
   * @param {any} of @param {() => void} changed
   */
  constructor(sketch, module, of, changed) {
    this.canvas = sketch.canvas;
    this.module = module;
    this.of = of;
    /** @type {Sketch[]} the others are made when they are first asked for */
    this.sketches = [sketch];
    /** @type {number[]} */
    this.outcomes = [];
    by("three").hidden = typeof of.size !== "number";
    by("sizes").checked = false;
    by("sizes").addEventListener("change", changed);
  }

  get on() {
    return by("sizes").checked;
  }

  /** Run the larger ones; returns the time of the last end. @param {Explorer} page */
  take({ values, outcome, end }) {
    if (!this.on) return 0;
    for (const _ of SIZES.slice(this.sketches.length))
      this.sketches.push(new Sketch(this.canvas, new Runner(this.module, this.of)));
    this.outcomes = this.sketches.map(({ runner }, k) => {
      if (k === 0) return outcome;
      const sized = [...values];
      sized[this.of.size] *= SIZES[k];
      return runner.run(sized, end);
    });
    this.sketches.forEach((sketch, k) => this.outcomes[k] >= 0 && sketch.measure());
    return Math.max(...this.sketches.map(({ runner }, k) => (this.outcomes[k] >= 0 ? runner.end : 0)));
  }

  /** How one ends. @param {number} k */
  word(k) {
    return outcomeWord(this.of.outcomes[this.outcomes[k]]);
  }

  sentence() {
    return SIZES.map((size, k) => `${fill(TEXTS.size, size)}: ${this.word(k)}.`).join(" ");
  }

  /** The ground stands still here, and the lines behind it move. @param {number} time @param {Float64Array} moved displacement of the ground */
  draw(time, moved) {
    const paint = pen(this.canvas);
    const { to, width, height, color } = paint;
    const level = height - 46;
    const largest = Math.max(...this.sketches.map((sketch) => sketch.size));
    const scale = Math.min((level - 14) / (1.05 * largest), width / (3 * largest));
    const { runner } = this.sketches[0];
    const shift = (moved[Math.min(Math.floor(time / runner.spacing[0]), SAMPLES - 1)] * scale) % 60;
    to.strokeStyle = color("faint");
    for (let x = -shift - 60; x < width + 60; x += 60) line(to, [x, 0], [x, level]);
    this.sketches[0].ground(paint, level, 0);
    const places = [0.14, 0.38, 0.72];
    this.sketches.forEach((sketch, k) => {
      const x = places[k] * width;
      if (this.outcomes[k] >= 0) sketch.stand(paint, [x, level], scale, sketch.runner.sample(time));
      to.fillStyle = color(this.of.outcomes[this.outcomes[k]] === "overturned" ? "orange" : "ink");
      write(to, fill(TEXTS.size, SIZES[k]), x, level + 24, "center");
      write(to, this.word(k), x, level + 39, "center");
    });
    to.textAlign = "left";
  }
}
