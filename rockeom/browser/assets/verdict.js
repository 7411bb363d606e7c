"use strict";
// A verdict in sentences: what lifts a foot, what slides first, and how many motions overturn it.

/** Time after the last move before motions are counted [ms]. */
const PAUSE = 150;

class Verdict {
  /** @param {Explorer} page */
  constructor(page) {
    this.page = page;
    this.number = 0;
    /** Place of the menu of motions, -1 if there is none. */
    this.place = page.inputs.findIndex(
      ({ name, options }) => options && options.length > 1 && ["motion", "record"].includes(name),
    );
  }

  /** Say it of the present values; the motions are counted after that. */
  show() {
    this.number += 1;
    this.say(this.place < 0 || !this.page.known ? [] : [fill(TEXTS.motions, "…", this.options())]);
    if (this.place >= 0 && this.page.known) this.count();
  }

  options() {
    return this.page.inputs[this.place].options?.length ?? 0;
  }

  /** @param {string[]} motions */
  say(motions) {
    const texts = this.page.known ? [...this.sentences(), ...motions] : [];
    by("verdict").replaceChildren(
      ...texts.map((textContent) => Object.assign(document.createElement("p"), { textContent })),
    );
  }

  sentences() {
    const { runner } = this.page;
    runner.lifted?.();
    const [uplift, friction] = runner.statics;
    return [
      Number.isFinite(uplift) && fill(TEXTS.uplift, few(uplift / G), few(uplift)),
      Number.isFinite(friction) && fill(TEXTS.slides, few(friction)),
    ].filter((text) => typeof text === "string");
  }

  /** Count the motions that overturn it, one at a time, until the values move. */
  count() {
    const { runner, of } = this.page;
    const [number, values, n] = [this.number, [...this.page.values], this.options()];
    let [falls, unknown, i] = [0, 0, 0];
    const next = () => {
      if (number !== this.number) return;
      values[this.place] = i;
      const outcome = runner.follow(values);
      if (outcome < 0) unknown += 1;
      else if (kindOf(of.outcomes[outcome]) === FALLS) falls += 1;
      i += 1;
      if (i < n) return void setTimeout(next);
      this.say([fill(unknown ? TEXTS.motionsUnknown : TEXTS.motions, falls, n, unknown)]);
      this.page.say();
    };
    setTimeout(next, PAUSE);
  }
}
