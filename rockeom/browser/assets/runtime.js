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

  /** Room for numbers of a shape: its place. @param {number[]} shape */
  room(shape) {
    const size = shape.reduce((a, b) => a * b, 1);
    const at = this.heap;
    this.heap += 8 * Math.max(size, 1);
    if (this.heap > this.memory.buffer.byteLength) throw new Error("the memory is full");
    return { at, size };
  }

  /** Numbers in the memory. @param {number[]} shape */
  floats(shape) {
    const { at, size } = this.room(shape);
    return Object.assign(new Float64Array(this.memory.buffer, at, size), { shape });
  }

  /** Whole numbers in the memory. @param {number[]} shape */
  wholes(shape) {
    const { at, size } = this.room(shape);
    return Object.assign(new BigInt64Array(this.memory.buffer, at, size), { shape });
  }

  /** A function with its arguments, by name. @param {string} name @param {Record<string, any>} given */
  bind(name, given) {
    /** @type {[string, string, number, number][]} */
    const places = [];
    let n = 0;
    for (const [argument, type, dimensions] of this.of.entries[name]) {
      places.push([argument, type, dimensions, n]);
      n += 1 + dimensions;
    }
    const row = this.wholes([n + 1]);
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

/** Time for which an impact flashes [s]. */
const FLASH = 0.15;
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
    this.program = program;
    this.sliders = program.floats([of.start.length]);
    this.p = program.floats([of.mostP]);
    this.numbers = program.floats([of.numbers]);
    this.states = program.floats([SAMPLES, n]);
    this.modes = program.wholes([SAMPLES]);
    this.ground = program.floats([of.ground.length, SAMPLES]); // the vertical one last
    this.impacts = program.floats([IMPACTS]);
    this.spacing = program.floats([3]);
    this.readings = program.floats([5]); // of questions
    this.y = program.floats([n]);
    this.places = program.floats([of.place * of.positions.length]);
    this.forces = program.floats([4 * of.elements.length]); // deformation, force, energy, loss
    this.corners = program.floats([2 * (of.corners.length + of.memberEnds.length + of.copies.length)]);
    this.energies = program.floats([5, SAMPLES]); // kinetic, gravitational, elastic; put in, lost
    this.angles = program.floats([2]);
    this.separatrix = program.floats([2, 128]);
    const { sliders, p, numbers, states, modes, ground, impacts, spacing, angles, separatrix } = this;
    const given = { sliders, end: 0, readings: this.readings };
    this.motion = program.bind("motion", { ...given, p, numbers, states, modes, ground, impacts, spacing });
    this.fate = program.bind("fate", given);
    if (of.entries.balance) this.balance = program.bind("balance", { p, numbers, angles, separatrix });
    /** The static uplift acceleration, and the friction that sliding first needs; of feet alone. */
    this.statics = program.floats([2]);
    if (of.entries.uplift_and_friction)
      this.lifted = program.bind("uplift_and_friction", { p, out: this.statics });
    const history = { states, modes, p, ground, spacing, out: this.energies };
    this.accounted = program.bind("energy_history", history);
    this.placed = program.bind("places", { mode: 0, y: this.y, p, out: this.places });
    /** The forces of elements; of ties and pushes alone. */
    if (of.entries.forces) this.pulled = program.bind("forces", { mode: 0, y: this.y, p, out: this.forces });
    this.shaped = program.bind("corners", { p, out: this.corners });
  }

  /** The outcome of the motion, -1 where the page does not know the case. @param {number[]} values @param {number} end at least [s] */
  run(values, end = 0) {
    this.sliders.set(values);
    this.motion.set("end", end);
    const outcome = this.motion();
    if (outcome >= 0) this.shaped();
    return outcome;
  }

  /** The outcome alone. @param {number[]} values */
  follow(values) {
    this.sliders.set(values);
    return this.fate();
  }

  /** How many samples the motion has. */
  get shown() {
    return Math.max(2, Math.round(this.spacing[1]));
  }

  /** The time of the last sample [s]. */
  get end() {
    return this.spacing[0] * (this.shown - 1);
  }

  /** The last sample before a time. @param {number} time */
  sample(time) {
    return Math.min(Math.floor(time / this.spacing[0]), this.shown - 1);
  }

  /** Part of the flash of the last impact that is over, 1 where there was none. @param {number} i */
  flash(i) {
    const { impacts, spacing } = this;
    const time = i * spacing[0];
    const last = impacts
      .subarray(0, spacing[2])
      .filter((x) => x <= time)
      .at(-1);
    return last === undefined ? 1 : Math.min((time - last) / FLASH, 1);
  }

  /** Places of bodies and feet at a sample. @param {number} i */
  at(i) {
    const n = this.of.states.length;
    this.y.set(this.states.subarray(i * n, (i + 1) * n));
    this.placed.set("mode", this.modes[i]);
    this.placed();
    this.pulled?.set("mode", this.modes[i]);
    this.pulled?.();
    return this.places;
  }

  /** The force of an element, NaN once it has broken; undefined of others. @param {string} name */
  force(name) {
    const broken = this.y[this.of.states.indexOf(`${name}_broken`)] > 0;
    return broken ? NaN : this.forces[4 * this.of.elements.indexOf(name) + 1];
  }
}
