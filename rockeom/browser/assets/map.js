"use strict";
// The outcome over two sliders, found row by row in a worker, which never blocks the page.

const CELLS = 60;
const COMES_BACK = 0;
const FALLS = 1;
const ELSE = 2;

/** The kind of an outcome for the map. @param {string[]} outcomes @param {number} code */
function kindOf(outcomes, code) {
  if (outcomes[code] === "overturned") return FALLS;
  return outcomes[code] === "completed" || outcomes[code] === "came to rest" ? COMES_BACK : ELSE;
}

/** The work of a worker: rows of outcomes for each map that is asked for. */
function work() {
  /** @type {Runner | undefined} */
  let runner;
  let wanted = 0;
  self.onmessage = async ({ data }) => {
    if (data.module) {
      runner = new Runner(data.module, data.of);
      return;
    }
    wanted = data.number;
    const { values, across, up } = data;
    for (let row = 0; row < CELLS && runner; row++) {
      const kinds = new Uint8Array(CELLS);
      for (let column = 0; column < CELLS; column++) {
        values[across.place] = across.low + ((column + 0.5) / CELLS) * (across.high - across.low);
        values[up.place] = up.low + ((row + 0.5) / CELLS) * (up.high - up.low);
        runner.sliders.set(values);
        kinds[column] = kindOf(runner.of.outcomes, runner.fate());
      }
      self.postMessage({ number: data.number, row, kinds });
      await new Promise((go) => setTimeout(go)); // a newer question may have come
      if (wanted !== data.number) return;
    }
  };
}

class OutcomeMap {
  /** @param {HTMLCanvasElement} canvas @param {WebAssembly.Module} module @param {any} of */
  constructor(canvas, module, of) {
    this.canvas = canvas;
    this.kinds = new Uint8Array(CELLS * CELLS).fill(255);
    this.number = 0;
    /** @type {number[] | undefined} */
    this.values = undefined;
    /** @type {any} */
    this.across = undefined;
    /** @type {any} */
    this.up = undefined;
    const code = /** @type {HTMLElement} */ (document.getElementById("code")).textContent;
    const address = URL.createObjectURL(new Blob([String(code)], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.worker.postMessage({ module, of });
    this.worker.onmessage = ({ data }) => {
      if (data.number !== this.number) return;
      this.kinds.set(data.kinds, data.row * CELLS);
      this.draw();
    };
  }

  /** @param {number[]} values @param {any} across @param {any} up */
  ask(values, across, up) {
    this.across = across;
    this.up = up;
    this.values = values;
    this.number += 1;
    this.worker.postMessage({ number: this.number, values: [...values], across, up });
    this.draw();
  }

  draw() {
    const { to, width, height, color } = pen(this.canvas);
    const colors = [color("safe"), color("fall"), color("unknown")];
    const [w, h] = [width / CELLS, height / CELLS];
    this.kinds.forEach((kind, i) => {
      if (kind > ELSE) return;
      to.fillStyle = colors[kind];
      const [row, column] = [Math.floor(i / CELLS), i % CELLS];
      to.fillRect(column * w, height - (row + 1) * h, w + 0.5, h + 0.5);
    });
    const values = this.values;
    if (!this.across || !values) return;
    const share = (/** @type {any} */ of) =>
      /** @type {any} */ (values[of.place] - of.low) / (of.high - of.low);
    const [x, y] = [share(this.across) * width, height * (1 - share(this.up))];
    to.strokeStyle = color("ink");
    to.lineWidth = 2.5;
    to.beginPath();
    to.arc(x, y, 7, 0, 7);
    to.stroke();
  }
}

if (typeof document === "undefined") work();
