"use strict";
// The page: sliders, the clock, and all views of one motion.

const TEXTS = {
  unknown: "This combination is outside of what the page knows: move a slider back.",
  play: "Play",
  pause: "Pause",
  copied: "Link copied",
  falls: "overturns",
  back: "does not",
  other: "other ends",
};
const SPEEDS = [1, 0.5, 0.25, 0.1];

/** @param {string} id @returns {any} */
function by(id) {
  return document.getElementById(id);
}

class Explorer {
  /** @param {WebAssembly.Module} module @param {any} of */
  constructor(module, of) {
    this.of = of;
    this.runner = new Runner(module, of);
    this.sketch = new Sketch(by("structure"), this.runner);
    this.charts = new Charts(by("history"), by("phase"), this.runner);
    this.map = new OutcomeMap(by("map"), module, of);
    this.values = [...of.start];
    this.time = 0;
    this.known = false;
    this.moved = new Float64Array(SAMPLES);
    this.playing = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.fromAddress();
    this.makeSliders();
    this.makeClock();
    this.makeMap();
    this.makeTools();
    this.move();
    this.askMap();
    window.addEventListener("resize", () => this.redraw());
    requestAnimationFrame((now) => this.frame(now, now));
  }

  // --- sliders

  makeSliders() {
    this.inputs = this.of.sliders.map((/** @type {any} */ slider, /** @type {number} */ i) => {
      const box = document.createElement("div");
      box.className = "slider";
      const label = document.createElement("label");
      const output = document.createElement("output");
      const input = document.createElement("input");
      Object.assign(input, { type: "range", id: `slider-${i}`, min: slider.low, max: slider.high });
      input.step = String((slider.high - slider.low) / 400);
      input.value = String(this.values[i]);
      label.htmlFor = input.id;
      label.title = slider.meaning;
      label.append(document.createTextNode(slider.name.replaceAll("_", " ")), output);
      input.addEventListener("input", () => {
        this.values[i] = Number(input.value);
        this.move();
      });
      input.addEventListener("change", () => this.askMap());
      box.append(label, input);
      by("controls").append(box);
      return { input, output };
    });
  }

  showValues() {
    this.inputs.forEach((/** @type {any} */ { input, output }, /** @type {number} */ i) => {
      const unit = this.of.sliders[i].unit === "-" ? "" : this.of.sliders[i].unit;
      const degrees = unit === "rad" ? ` (${few((this.values[i] * 180) / Math.PI)}°)` : "";
      output.textContent = `${few(this.values[i])} ${unit}${degrees}`;
      if (Number(input.value) !== this.values[i]) input.value = String(this.values[i]);
    });
  }

  /** The sliders have moved: integrate, and draw everything. */
  move() {
    const outcome = this.runner.run(this.values);
    this.showValues();
    this.known = outcome >= 0;
    if (this.known) this.charts.take();
    by("verdict").textContent = this.known ? this.sentence(outcome) : TEXTS.unknown;
    if (!this.known) return;
    const end = this.runner.spacing[0] * (this.charts.shown() - 1);
    by("time").max = String(end);
    this.time = Math.min(this.time, end);
    this.sketch.measure();
    this.moved = this.displacement();
    this.redraw();
  }

  /** Displacement of the ground at each sample [m], by the trapezoidal rule, twice. */
  displacement() {
    const { ground, spacing } = this.runner;
    const moved = new Float64Array(SAMPLES);
    let speed = 0;
    for (let i = 1; i < SAMPLES; i++) {
      const faster = speed + (spacing[0] * (ground[i - 1] + ground[i])) / 2;
      moved[i] = moved[i - 1] + (spacing[0] * (speed + faster)) / 2;
      speed = faster;
    }
    return moved;
  }

  /** @param {number} outcome */
  sentence(outcome) {
    const { of, spacing } = this.runner;
    const most = Math.abs(peak(this.charts.rotation));
    const word = of.outcomes[outcome];
    const impacts = spacing[2] === 1 ? "1 impact" : `${spacing[2]} impacts`;
    const unit = of.stateUnits[of.rotation];
    const degrees = unit === "rad" ? ` (${few((most * 180) / Math.PI)}°)` : "";
    return `${word[0].toUpperCase()}${word.slice(1)}: largest ${of.states[of.rotation]} ${few(most)} ${unit}${degrees}, ${impacts}.`;
  }

  // --- time

  makeClock() {
    for (const speed of SPEEDS) by("speed").add(new Option(`${speed} ×`, String(speed)));
    const name = () => (by("play").textContent = this.playing ? TEXTS.pause : TEXTS.play);
    name();
    by("play").addEventListener("click", () => {
      this.playing = !this.playing;
      name();
    });
    by("time").addEventListener("input", () => {
      this.playing = false;
      name();
      this.time = Number(by("time").value);
      this.redraw();
    });
  }

  /** @param {number} now @param {number} before */
  frame(now, before) {
    if (this.playing && this.known) {
      const end = Number(by("time").max);
      this.time += ((now - before) / 1000) * Number(by("speed").value);
      if (this.time > end) this.time = 0;
      by("time").value = String(this.time);
      this.redraw();
    }
    requestAnimationFrame((next) => this.frame(next, now));
  }

  redraw() {
    if (!this.known) return;
    const sample = Math.min(Math.floor(this.time / this.runner.spacing[0]), this.charts.shown() - 1);
    this.sketch.draw(sample, this.moved[sample]);
    this.charts.draw(sample);
    this.map.draw();
    by("now").textContent = `${this.time.toFixed(2)} s of ${few(Number(by("time").max))} s`;
  }

  // --- the map

  makeMap() {
    const names = this.of.sliders.map((/** @type {any} */ s) => s.name.replaceAll("_", " "));
    for (const id of ["across", "up"]) {
      names.forEach((/** @type {string} */ name, /** @type {number} */ i) =>
        by(id).add(new Option(name, String(i))),
      );
      by(id).addEventListener("change", () => this.askMap());
    }
    by("up").value = String(Math.min(1, names.length - 1));
    const keys = [
      ["fall", TEXTS.falls],
      ["safe", TEXTS.back],
      ["unknown", TEXTS.other],
    ];
    for (const [color, text] of keys) {
      const key = document.createElement("span");
      key.className = "key";
      key.style.background = `var(--${color})`;
      by("legend").append(key, document.createTextNode(`${text} `));
    }
    const drag = (/** @type {PointerEvent} */ event) => {
      if (!event.buttons) return;
      const box = by("map").getBoundingClientRect();
      this.point((event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height);
    };
    by("map").addEventListener("pointerdown", drag);
    by("map").addEventListener("pointermove", drag);
    by("map").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step) return;
      event.preventDefault();
      const [across, up] = this.axes();
      const share = (/** @type {any} */ a) => (this.values[a.place] - a.low) / (a.high - a.low);
      this.point(share(across) + step[0] / CELLS, share(up) + step[1] / CELLS);
    });
  }

  axes() {
    return ["across", "up"].map((id) => {
      const place = Number(by(id).value);
      return { place, low: this.of.sliders[place].low, high: this.of.sliders[place].high };
    });
  }

  /** Move the point of the map. @param {number} x @param {number} y shares of the axes */
  point(x, y) {
    const within = (/** @type {number} */ share) => Math.min(Math.max(share, 0), 1);
    const [across, up] = this.axes();
    this.values[across.place] = across.low + within(x) * (across.high - across.low);
    this.values[up.place] = up.low + within(y) * (up.high - up.low);
    this.move();
  }

  askMap() {
    const [across, up] = this.axes();
    this.map.ask(this.values, across, up);
    this.remember();
  }

  // --- address, and files

  /** Put the values into the address. */
  remember() {
    try {
      history.replaceState(null, "", `#${this.address()}`);
    } catch {
      // a frame, as in a notebook, has no address of its own
    }
  }

  address() {
    return this.of.sliders
      .map((/** @type {any} */ s, /** @type {number} */ i) => `${s.name}=${this.values[i]}`)
      .join("&");
  }

  /** Values of the address; what is no number is left, and what is outside is put to the end. */
  fromAddress() {
    const given = new URLSearchParams(location.hash.slice(1));
    this.of.sliders.forEach((/** @type {any} */ slider, /** @type {number} */ i) => {
      const text = given.get(slider.name);
      const value = Number(text);
      if (text && Number.isFinite(value)) this.values[i] = Math.min(Math.max(value, slider.low), slider.high);
    });
  }

  makeTools() {
    by("share").addEventListener("click", async () => {
      this.remember();
      await navigator.clipboard?.writeText(location.href);
      by("share").textContent = TEXTS.copied;
    });
    by("reset").addEventListener("click", () => {
      this.values = [...this.of.start];
      this.move();
      this.askMap();
    });
    by("csv").addEventListener("click", () =>
      save("motion.csv", URL.createObjectURL(new Blob([this.csv()], { type: "text/csv" }))),
    );
    by("png").addEventListener("click", () => save("structure.png", by("structure").toDataURL("image/png")));
  }

  csv() {
    const { states, ground, spacing } = this.runner;
    const n = this.of.states.length;
    const head = [
      "t [s]",
      ...this.of.states.map(
        (/** @type {string} */ s, /** @type {number} */ j) => `${s} [${this.of.stateUnits[j]}]`,
      ),
      "ground [m/s2]",
    ];
    const rows = Array.from({ length: this.charts.shown() }, (_, i) =>
      [i * spacing[0], ...states.subarray(i * n, (i + 1) * n), ground[i]].join(","),
    );
    return [head.join(","), ...rows].join("\n");
  }
}

/** @param {string} name @param {string} address */
function save(name, address) {
  Object.assign(document.createElement("a"), { download: name, href: address }).click();
}

async function start() {
  const data = JSON.parse(by("data").textContent);
  const module = await WebAssembly.compile(await unpacked(data.program));
  return new Explorer(module, data.of);
}

if (typeof document !== "undefined") {
  start().catch((error) => (by("verdict").textContent = `The page cannot run here: ${error.message}`));
}
