"use strict";
// The outcome over two sliders, found in workers, which never block the page: first at the middle of
// each cell, then at all parts of the cells beside a border, along which this goes on.

const CELLS = 60;
/** Parts of a divided cell along each axis. */
const PARTS = 3;
const FINE = CELLS * PARTS;
const COMES_BACK = 0;
const FALLS = 1;
const ELSE = 2;
const NOT_YET = 3;
/** Workers, each with every second row of parts: a page has two cores at least. */
const WORKERS = 2;

/** The kind of an outcome for the map. @param {string} word */
function kindOf(word) {
  if (word === "overturned") return FALLS;
  return word === "completed" || word === "came to rest" ? COMES_BACK : ELSE;
}

/** Time after which a worker tells what it has, and looks for a newer question [ms]. */
const TURN = 25;

/** The work of a worker: the outcomes at some parts of the map, until others are asked for. */
function work() {
  /** @type {Runner | undefined} */
  let runner;
  let wanted = 0;
  self.onmessage = async ({ data }) => {
    if (data.module) {
      runner = new Runner(data.module, data.of);
      return;
    }
    const { number, values, across, up, parts } = data;
    wanted = number;
    const codes = new Int8Array(parts.length);
    let [since, from] = [performance.now(), 0];
    for (let k = 0; runner && k < parts.length; k++) {
      values[across.place] = across.low + (((parts[k] % FINE) + 0.5) / FINE) * (across.high - across.low);
      values[up.place] = up.low + ((Math.floor(parts[k] / FINE) + 0.5) / FINE) * (up.high - up.low);
      codes[k] = runner.follow(values);
      if (performance.now() - since < TURN && k < parts.length - 1) continue;
      self.postMessage({ number, parts: parts.slice(from, k + 1), codes: codes.slice(from, k + 1) });
      await new Promise((go) => setTimeout(go));
      if (wanted !== number) return;
      [since, from] = [performance.now(), k + 1];
    }
  };
}

/** The parts of a cell and those around it, the middle one first. @param {number} cell @param {number} reach @returns {number[]} */
function partsOf(cell, reach) {
  const [row, column] = [Math.floor(cell / CELLS), cell % CELLS].map((k) => k * PARTS + 1);
  const parts = [row * FINE + column];
  for (let y = Math.max(row - reach, 0); y <= Math.min(row + reach, FINE - 1); y++) {
    for (let x = Math.max(column - reach, 0); x <= Math.min(column + reach, FINE - 1); x++)
      if (x !== column || y !== row) parts.push(y * FINE + x);
  }
  return parts;
}

class OutcomeMap {
  /** @param {HTMLCanvasElement} canvas @param {WebAssembly.Module} module @param {any} of */
  constructor(canvas, module, of) {
    this.canvas = canvas;
    this.of = of;
    /** What each part shows. */
    this.kinds = new Uint8Array(FINE * FINE).fill(NOT_YET);
    /** Words of outcomes that are neither. @type {Set<string>} */
    this.others = new Set();
    this.divided = new Uint8Array(CELLS * CELLS);
    this.dividing = false;
    /** Parts that were asked for. */
    this.left = 0;
    this.number = 0;
    /** @type {number[] | undefined} the values of the page, which move */
    this.values = undefined;
    /** @type {number[]} those of the map */
    this.asked = [];
    /** @type {any} */
    this.across = undefined;
    /** @type {any} */
    this.up = undefined;
    this.stopped = this.due = false;
    const code = /** @type {HTMLElement} */ (document.getElementById("code")).textContent;
    const address = URL.createObjectURL(new Blob([String(code)], { type: "text/javascript" }));
    this.workers = Array.from({ length: WORKERS }, () => {
      const worker = new Worker(address);
      worker.postMessage({ module, of });
      worker.onmessage = ({ data }) => this.take(data);
      return worker;
    });
  }

  /** @param {number[]} values @param {any} across @param {any} up */
  ask(values, across, up) {
    this.values = values;
    if (this.same() && across.place === this.across?.place && up.place === this.up?.place) return;
    [this.across, this.up, this.asked] = [across, up, [...values]];
    this.stopped = this.dividing = false;
    this.divided.fill(0);
    this.others.clear();
    this.send(Array.from(this.divided, (_, cell) => partsOf(cell, 0)[0]));
    this.draw();
  }

  /** Ask the workers, which leave what they were asked before. @param {number[]} parts */
  send(parts) {
    this.number += 1;
    this.left = parts.length;
    const { number, across, up, asked } = this;
    this.workers.forEach((worker, first) => {
      const own = parts.filter((_, k) => Math.floor(k / CELLS) % WORKERS === first);
      worker.postMessage({ number, values: [...asked], across, up, parts: own });
    });
  }

  /** Take what a worker has found: of a cell that is not divided all parts show its middle. @param {any} data */
  take({ number, parts, codes }) {
    if (number !== this.number) return;
    parts.forEach((/** @type {number} */ part, /** @type {number} */ k) => {
      const word = this.of.outcomes[codes[k]];
      const cell = Math.floor(part / FINE / PARTS) * CELLS + Math.floor((part % FINE) / PARTS);
      for (const shown of this.dividing ? [part] : partsOf(cell, 1)) this.kinds[shown] = kindOf(word);
      if (kindOf(word) === ELSE) this.others.add(outcomeWord(word));
    });
    this.left -= parts.length;
    if (!this.left) this.divide();
    this.due = true;
    requestAnimationFrame(() => this.due && this.draw());
  }

  /** Ask for the parts of all cells beside a border that are not divided yet. */
  divide() {
    const beside = Array.from(this.divided.keys()).filter((cell) => {
      const [middle, ...around] = partsOf(cell, 2).map((part) => this.kinds[part]);
      return !this.divided[cell] && around.some((kind) => kind !== middle);
    });
    this.dividing = true;
    for (const cell of beside) this.divided[cell] = 1;
    if (beside.length) this.send(beside.flatMap((cell) => partsOf(cell, 1).slice(1)));
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
    return [48, 24, width - 10, height - 36];
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
      this.send([]);
    }
    const paint = pen(this.canvas);
    const { to, width, height, color } = paint;
    const axes = new Axes(paint, this.box(width, height), [across.low, across.high], [up.low, up.high]);
    axes.rows(ends(axes.up));
    axes.columns("", ends(axes.across));
    to.globalAlpha = this.stopped ? 0.35 : 1;
    this.parts(axes);
    to.globalAlpha = 1;
    to.fillStyle = color("ink");
    write(to, this.title(up.place), 6, 13);
    write(to, this.title(across.place), width - 10, height - 6, "right");
    to.strokeStyle = color("ink");
    to.fillStyle = color("paper");
    to.lineWidth = 2.5;
    disc(to, axes.x(values[across.place]), axes.y(values[up.place]), 7);
    to.fill();
    to.stroke();
  }

  /** The parts that are known, and why some end otherwise. @param {Axes} axes */
  parts({ to, color, left, top, right, bottom }) {
    const colors = [color("safe"), color("fall"), color("unknown"), color("paper")];
    const x = Array.from({ length: FINE + 1 }, (_, k) => Math.round(left + (k * (right - left)) / FINE));
    const y = Array.from({ length: FINE + 1 }, (_, k) => Math.round(bottom - (k * (bottom - top)) / FINE));
    for (let i = 0, end = 0; i < FINE * FINE; i = end) {
      const kind = this.kinds[i];
      for (end = i + 1; end % FINE && this.kinds[end] === kind;) end++; // a row of one kind
      const [row, first] = [Math.floor(i / FINE), i % FINE];
      to.fillStyle = colors[kind];
      to.fillRect(x[first], y[row + 1], x[first + end - i] - x[first], y[row] - y[row + 1]);
    }
    by("others").hidden = !this.others.size;
    by("reasons").textContent = fill(TEXTS.other, [...this.others].join(", "));
  }

  /** @param {number} place */
  title(place) {
    const { name, unit } = this.of.sliders[place];
    return !unit || unit === "-" ? words(name) : `${words(name)} [${unit.replaceAll("2", "²")}]`;
  }
}

if (typeof document === "undefined") work();
