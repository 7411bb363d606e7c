"use strict";
// The page: values, the motion that they give, the clock, and what shows it.

const SPEEDS = [1, 0.5, 0.25, 0.1];
/** Silence before a screen reader is told [ms]: it would be told of every step of a slider. */
const SILENCE = 700;

/** @param {string} id @returns {any} */
function by(id) {
  return document.getElementById(id);
}

class Explorer {
  /** @param {WebAssembly.Module} module @param {any} of */
  constructor(module, of) {
    this.of = of;
    this.inputs = inputsOf(of);
    /** @type {number[]} of the inputs, and of the size where the program has one */
    this.values = [...of.start];
    this.runner = new Runner(module, of);
    /** @type {any} of the plane or of space */
    this.sketch = undefined;
    /** @type {Charts} */
    this.charts = of.space ? inSpace(this) : inPlane(this);
    this.sizes = new Sizes(this.sketch, module, of, () => this.move());
    this.map = new OutcomeMap(by("map"), module, of);
    this.panel = new Panel(this);
    this.plane = new Plane(this, this.map);
    this.lesson = of.questions?.length ? new Lesson(this) : undefined;
    this.verdict = this.runner.lifted ? new Verdict(this) : undefined;
    this.mode = "explore";
    /** Time until which motions go on at least [s]: of a question, until its answer is settled. */
    this.end = 0;
    this.outcome = -1;
    this.known = false;
    this.time = 0;
    this.playing = false;
    this.saying = 0;
    /** What to say of values from outside at the next move; the one after takes it away. */
    this.note = "";
    this.moved = new Float64Array(SAMPLES);
    makeTools(this);
    this.makeModes();
    this.makeClock();
    readAddress(this);
    listen(this);
    this.set({});
    this.restart();
    window.addEventListener("resize", () => this.redraw());
    requestAnimationFrame((now) => this.frame(now, now));
  }

  // --- values

  /** Set some values by their place, within their ranges. @param {Record<string, number>} given */
  set(given) {
    for (const [place, x] of Object.entries(given)) {
      const input = this.inputs[Number(place)];
      if (input) this.values[Number(place)] = within(x, input);
    }
    this.move();
    this.settle();
  }

  /** The values have moved: integrate, and draw everything. */
  move() {
    this.outcome = this.runner.run(this.values, this.end);
    this.known = this.outcome >= 0;
    by("note").textContent = this.note;
    this.note = "";
    this.panel.show();
    if (this.known) this.charts.take();
    by("outcome").textContent = this.known ? this.sentence() : TEXTS.unknown;
    if (this.mode === "verdict") this.verdict?.show();
    this.say();
    tell(this);
    if (!this.known) return;
    const end = Math.max(this.runner.end, this.sizes.take(this));
    by("time").max = String(end);
    this.time = Math.min(this.time, end);
    this.moved = this.displacement(0);
    this.sketch.measure(this);
    this.sketch.describe(this.sizes.on ? this.sizes.sentence() : this.sentence());
    this.redraw();
  }

  /** The values stay for now: ask for the map, and put them into the address. */
  settle() {
    this.plane.ask();
    remember(this);
  }

  /** Displacement of the ground along an axis at each sample [m], by the trapezoidal rule, twice. @param {number} axis */
  displacement(axis) {
    const { spacing } = this.runner;
    const ground = this.runner.ground.subarray(axis * SAMPLES);
    const moved = new Float64Array(SAMPLES);
    let speed = 0;
    for (let i = 1; i < SAMPLES; i++) {
      const faster = speed + (spacing[0] * (ground[i - 1] + ground[i])) / 2;
      moved[i] = moved[i - 1] + (spacing[0] * (speed + faster)) / 2;
      speed = faster;
    }
    // a pulse leaves the ground moving on: in axes of its mean velocity it ends where it began
    const drift = moved[SAMPLES - 1] / (SAMPLES - 1);
    return moved.map((x, i) => x - drift * i);
  }

  // --- sentences

  sentence() {
    const { of, runner, charts } = this;
    const most = quantity(Math.abs(peak(charts.rotation)), of.stateUnits[of.rotation]);
    const [, , number] = runner.readings;
    const impacts = number === 1 ? TEXTS.impact : fill(TEXTS.impacts, number);
    return fill(TEXTS.summary, outcomeWord(of.outcomes[this.outcome]), charts.name, most, impacts);
  }

  /** Tell a screen reader what there is to read, once the values rest. */
  say() {
    clearTimeout(this.saying);
    this.saying = setTimeout(() => {
      const parts = ["note", "outcome", ...(this.mode === "verdict" ? ["verdict"] : [])];
      by("said").textContent = parts.map((id) => by(id).innerText).join(" ");
    }, SILENCE);
  }

  // --- modes

  makeModes() {
    const { lesson, verdict } = this;
    by("modes").hidden = !lesson && !verdict;
    for (const [mode, there] of Object.entries({ explore: true, questions: lesson, verdict })) {
      const radio = by(`mode-${mode}`);
      radio.parentElement.hidden = !there;
      radio.checked = mode === "explore"; // browsers keep what was checked before a reload
      radio.addEventListener("change", () => this.enter(mode));
    }
  }

  /** @param {string} mode */
  enter(mode) {
    this.mode = mode;
    for (const id of ["questions", "verdict"]) by(id).hidden = id !== mode;
    this.end = 0;
    this.lock(false);
    if (mode === "questions") this.lesson?.open();
    else this.move();
  }

  /** Hold the controls and hide the map, which tell the answer of a question. @param {boolean} locked */
  lock(locked) {
    by("controls").disabled = locked;
    by("plane").hidden = locked;
    this.redraw();
  }

  // --- time

  makeClock() {
    for (const speed of SPEEDS) by("speed").add(new Option(`${speed} ×`, String(speed)));
    by("play").addEventListener("click", () => this.play(!this.playing));
    by("time").addEventListener("input", () => {
      this.play(false);
      this.time = Number(by("time").value);
      this.redraw();
    });
  }

  /** @param {boolean} playing */
  play(playing) {
    this.playing = playing;
    by("play").textContent = playing ? TEXTS.pause : TEXTS.play;
  }

  /** Begin the motion anew, at rest for who wants no motion. */
  restart() {
    this.time = 0;
    this.play(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
    this.redraw();
  }

  /** @param {number} now @param {number} before */
  frame(now, before) {
    if (this.playing && this.known) {
      const end = Number(by("time").max);
      this.time += ((now - before) / 1000) * Number(by("speed").value);
      if (this.time > end) this.time = 0;
      this.redraw();
    }
    requestAnimationFrame((next) => this.frame(next, now));
  }

  redraw() {
    if (!this.known) return;
    const sample = this.runner.sample(this.time);
    if (this.sizes.on) this.sizes.draw(this.time, this.moved);
    else this.sketch.draw(sample, this.moved[sample]);
    this.charts.draw(sample);
    this.map.draw();
    by("time").value = String(this.time);
    by("time").setAttribute("aria-valuetext", fill(TEXTS.seconds, this.time.toFixed(2)));
    by("now").textContent = fill(TEXTS.now, this.time.toFixed(2), few(Number(by("time").max)));
  }
}

async function start() {
  translate();
  const data = JSON.parse(by("data").textContent);
  const module = await WebAssembly.compile(await unpacked(data.program));
  if (data.surfaces) data.of.surfaces = await unpacked(data.surfaces);
  return new Explorer(module, data.of);
}

if (typeof document !== "undefined") {
  start().catch((error) => (by("outcome").textContent = fill(TEXTS.broken, error.message)));
}
