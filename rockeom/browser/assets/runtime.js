"use strict";
// A program of rockeom in WebAssembly: its memory, and functions that take a row of 64-bit places.

const STACK = 1 << 20;
const PAGE = 1 << 16;

/** The bytes of a gzipped text in base64. @param {string} text @returns {Promise<ArrayBuffer>} */
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

class Program {
  /** @param {WebAssembly.Module} module @param {any} of the description of the page */
  constructor(module, of) {
    this.of = of;
    this.heap = (of.dataEnd + STACK + 15) & ~15; // the stack grows down to the data
    this.memory = new WebAssembly.Memory({ initial: Math.ceil(this.heap / PAGE) + 512 });
    const pointer = new WebAssembly.Global({ value: "i32", mutable: true }, this.heap);
    const env = { __linear_memory: this.memory, __stack_pointer: pointer };
    this.exports = new WebAssembly.Instance(module, { env }).exports;
  }

  /** Numbers in the memory. @param {number[]} shape @param {boolean} [whole] */
  array(shape, whole = false) {
    const n = shape.reduce((a, b) => a * b, 1);
    const Kind = whole ? BigInt64Array : Float64Array;
    const found = new Kind(this.memory.buffer, this.heap, n);
    this.heap += 8 * Math.max(n, 1);
    if (this.heap > this.memory.buffer.byteLength) throw new Error("the memory is full");
    return Object.assign(found, { shape });
  }

  /** A function with its arguments, by name. @param {string} name @param {Record<string, any>} given */
  bind(name, given) {
    const places = [];
    let n = 0;
    for (const [argument, type, dimensions] of this.of.entries[name]) {
      places.push([argument, type, dimensions, n]);
      n += 1 + dimensions;
    }
    const row = this.array([n + 1], true);
    const floats = new Float64Array(row.buffer, row.byteOffset, n + 1);
    /** @param {string} argument @param {any} value */
    const set = (argument, value) => {
      const [, type, dimensions, at] = /** @type {any[]} */ (places.find((p) => p[0] === argument));
      if (dimensions) {
        row[at] = BigInt(value.byteOffset);
        for (let i = 0; i < dimensions; i++) row[at + 1 + i] = BigInt(value.shape[i]);
      } else if (type === "double") floats[at] = value;
      else row[at] = BigInt(value);
    };
    for (const argument in given) set(argument, given[argument]);
    const f = /** @type {any} */ (this.exports[name]);
    const call = () => {
      f(row.byteOffset);
      return Number(row[n]);
    };
    return Object.assign(call, { set });
  }
}

/** Samples of a motion. */
const SAMPLES = 4801;
const IMPACTS = 2000;

/** A motion at a time: its arrays, and the functions that fill them. */
class Runner {
  /** @param {WebAssembly.Module} module @param {any} of */
  constructor(module, of) {
    const program = new Program(module, of);
    const n = of.states.length;
    this.of = of;
    this.sliders = program.array([of.sliders.length]);
    this.p = program.array([of.mostP]);
    this.numbers = program.array([9]);
    this.states = program.array([SAMPLES, n]);
    this.modes = program.array([SAMPLES], true);
    this.ground = program.array([SAMPLES]);
    this.impacts = program.array([IMPACTS]);
    this.spacing = program.array([4]);
    this.extremes = program.array([2, n]);
    this.y = program.array([n]);
    this.places = program.array([3 * of.positions.length]);
    this.corners = program.array([2 * (of.corners.length + of.memberEnds.length + of.copies.length)]);
    const { sliders, p, numbers, states, modes, ground, impacts, spacing } = this;
    this.motion = program.bind("motion", { sliders, p, numbers, states, modes, ground, impacts, spacing });
    this.fate = program.bind("fate", { sliders, extremes: this.extremes });
    this.placed = program.bind("places", { mode: 0, y: this.y, p, out: this.places });
    this.shaped = program.bind("corners", { p, out: this.corners });
  }

  /** The outcome of the motion, -1 where the page does not know the case. @param {number[]} values */
  run(values) {
    this.sliders.set(values);
    const outcome = this.motion();
    if (outcome >= 0) this.shaped();
    return outcome;
  }

  /** Places of bodies and feet at a sample. @param {number} i */
  at(i) {
    const n = this.of.states.length;
    this.y.set(this.states.subarray(i * n, (i + 1) * n));
    this.placed.set("mode", this.modes[i]);
    this.placed();
    return this.places;
  }
}
