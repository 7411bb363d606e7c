"use strict";
// The outcome over two sliders, found row by row in workers, which never block the page.

const CELLS = 60;
const COMES_BACK = 0;
const FALLS = 1;
const ELSE = 2;
const NOT_YET = 255;
/** Workers, each with every second row: a page has two cores at least. */
const WORKERS = 2;

/** The kind of an outcome for the map. @param {string[]} outcomes @param {number} code */
function kindOf(outcomes, code) {
  if (outcomes[code] === "overturned") return FALLS;
  return outcomes[code] === "completed" || outcomes[code] === "came to rest" ? COMES_BACK : ELSE;
}

/** Time after which a worker looks for a newer question [ms]. */
const TURN = 25;

/** The work of a worker: rows of outcomes for each map that is asked for, until another one is. */
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
    let since = performance.now();
    for (let row = data.first; values && row < CELLS && runner; row += WORKERS) {
      const kinds = new Uint8Array(CELLS);
      for (let column = 0; column < CELLS; column++) {
        values[across.place] = across.low + ((column + 0.5) / CELLS) * (across.high - across.low);
        values[up.place] = up.low + ((row + 0.5) / CELLS) * (up.high - up.low);
        runner.sliders.set(values);
        kinds[column] = kindOf(runner.of.outcomes, runner.fate());
        if (performance.now() - since < TURN) continue;
        await new Promise((go) => setTimeout(go));
        if (wanted !== data.number) return;
        since = performance.now();
      }
      self.postMessage({ number: data.number, row, kinds });
    }
  };
}

class OutcomeMap {
  /** @param {HTMLCanvasElement} canvas @param {WebAssembly.Module} module @param {any} of */
  constructor(canvas, module, of) {
    this.canvas = canvas;
    this.of = of;
    this.kinds = new Uint8Array(CELLS * CELLS).fill(NOT_YET);
    this.number = 0;
    /** @type {number[] | undefined} the values of the page, which move */
    this.values = undefined;
    /** @type {number[]} those of the map */
    this.asked = [];
    /** @type {any} */
    this.across = undefined;
    /** @type {any} */
    this.up = undefined;
    this.stopped = false;
    const code = /** @type {HTMLElement} */ (document.getElementById("code")).textContent;
    const address = URL.createObjectURL(new Blob([String(code)], { type: "text/javascript" }));
    this.workers = Array.from({ length: WORKERS }, () => {
      const worker = new Worker(address);
      worker.postMessage({ module, of });
      worker.onmessage = ({ data }) => {
        if (data.number !== this.number) return;
        this.kinds.set(data.kinds, data.row * CELLS);
        this.due = true;
        requestAnimationFrame(() => this.due && this.draw());
      };
      return worker;
    });
  }

  /** @param {number[]} values @param {any} across @param {any} up */
  ask(values, across, up) {
    this.values = values;
    if (this.same() && across.place === this.across?.place && up.place === this.up?.place) return;
    [this.across, this.up, this.asked] = [across, up, [...values]];
    this.stopped = false;
    this.send([...values]);
    this.draw();
  }

  /** Ask the workers; without values they stop. @param {number[]} [values] */
  send(values) {
    this.number += 1;
    const { number, across, up } = this;
    this.workers.forEach((worker, first) => worker.postMessage({ number, values, across, up, first }));
  }

  /** Whether the map is that of the present values, which may differ from its own along its axes. */
  same() {
    const along = [this.across?.place, this.up?.place];
    return (
      !this.stopped &&
      this.asked.length > 0 &&
      (this.values ?? []).every((x, i) => along.includes(i) || x === this.asked[i])
    );
  }

  /** The place of the map in its canvas: left, top, right, bottom. @param {number} width @param {number} height @returns {[number, number, number, number]} */
  box(width, height) {
    return [48, 24, width - 10, height - 20];
  }

  /** Shares of the axes at a place of the canvas. @param {PointerEvent} event */
  shares({ clientX, clientY }) {
    const frame = this.canvas.getBoundingClientRect();
    const [left, top, right, bottom] = this.box(frame.width, frame.height);
    return [(clientX - frame.left - left) / (right - left), (frame.top + bottom - clientY) / (bottom - top)];
  }

  draw() {
    this.due = false;
    const { across, up, values } = this;
    if (!across || !values) return;
    if (!this.stopped && !this.same()) {
      this.stopped = true; // a map of other values: it fades until it is asked for anew
      this.send();
    }
    const paint = pen(this.canvas);
    const { to, width, height, color } = paint;
    const axes = new Axes(paint, this.box(width, height), [across.low, across.high], [up.low, up.high]);
    axes.rows(ends(axes.up));
    axes.columns("", ends(axes.across));
    to.globalAlpha = this.stopped ? 0.35 : 1;
    this.cells(axes);
    to.globalAlpha = 1;
    to.fillStyle = color("ink");
    write(to, this.title(up.place), 6, 13);
    write(to, this.title(across.place), width - 10, 13, "right");
    to.strokeStyle = color("ink");
    to.fillStyle = color("paper");
    to.lineWidth = 2.5;
    disc(to, axes.x(values[across.place]), axes.y(values[up.place]), 7);
    to.fill();
    to.stroke();
  }

  /** Cells that are known, and lines between those of different outcomes. @param {Axes} axes */
  cells({ to, color, left, top, right, bottom }) {
    const colors = [color("safe"), color("fall"), color("unknown")];
    const x = Array.from({ length: CELLS + 1 }, (_, k) => Math.round(left + (k * (right - left)) / CELLS));
    const y = Array.from({ length: CELLS + 1 }, (_, k) => Math.round(bottom - (k * (bottom - top)) / CELLS));
    const between = new Path2D();
    this.kinds.forEach((kind, i) => {
      if (kind === NOT_YET) return;
      const [row, column] = [Math.floor(i / CELLS), i % CELLS];
      to.fillStyle = colors[kind];
      to.fillRect(x[column], y[row + 1], x[column + 1] - x[column], y[row] - y[row + 1]);
      if (column && differ(kind, this.kinds[i - 1])) {
        between.moveTo(x[column], y[row]);
        between.lineTo(x[column], y[row + 1]);
      }
      if (row && differ(kind, this.kinds[i - CELLS])) {
        between.moveTo(x[column], y[row]);
        between.lineTo(x[column + 1], y[row]);
      }
    });
    to.strokeStyle = color("ink");
    to.lineWidth = 1.5;
    to.stroke(between);
  }

  /** @param {number} place */
  title(place) {
    const { name, unit } = this.of.sliders[place];
    return !unit || unit === "-" ? words(name) : `${words(name)} [${unit.replaceAll("2", "²")}]`;
  }
}

/** @param {number} a @param {number} b */
function differ(a, b) {
  return a !== b && a !== NOT_YET && b !== NOT_YET;
}

if (typeof document === "undefined") work();
