"use strict";
// The plane of the map: which sliders are its axes, and its point, which the mouse and keys move.

class Plane {
  /** @param {Explorer} page @param {OutcomeMap} map */
  constructor(page, map) {
    this.page = page;
    this.map = map;
    const names = page.of.sliders.map((/** @type {any} */ s) => words(s.name));
    for (const id of ["across", "up"]) {
      names.forEach((/** @type {string} */ name, /** @type {number} */ i) =>
        by(id).add(new Option(name, String(i))),
      );
      by(id).addEventListener("change", () => this.ask());
    }
    [by("across").value, by("up").value] = page.of.axes.map(String);
    this.followPointer();
    this.followKeys();
  }

  followPointer() {
    const canvas = by("map");
    const drag = (/** @type {PointerEvent} */ event) => {
      if (!event.buttons) return;
      const [x, y] = this.map.shares(event);
      this.point(x, y);
    };
    canvas.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
      canvas.setPointerCapture(event.pointerId);
      drag(event);
    });
    canvas.addEventListener("pointermove", drag);
    canvas.addEventListener("pointerup", () => remember(this.page));
  }

  followKeys() {
    by("map").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step) return;
      event.preventDefault();
      const [x, y] = this.axes().map((a) => (this.page.values[a.place] - a.low) / (a.high - a.low));
      this.point(x + step[0] / CELLS, y + step[1] / CELLS);
    });
    by("map").addEventListener("keyup", () => remember(this.page));
  }

  axes() {
    return ["across", "up"].map((id) => {
      const place = Number(by(id).value);
      const { low, high } = this.page.inputs[place];
      return { place, low, high };
    });
  }

  /** Move the point. @param {number} x @param {number} y shares of the axes */
  point(x, y) {
    this.axes().forEach((axis, k) => {
      const share = within([x, y][k], { low: 0, high: 1 });
      this.page.values[axis.place] = axis.low + share * (axis.high - axis.low);
    });
    this.page.move();
  }

  /** Ask for the map of the present values. */
  ask() {
    const [across, up] = this.axes();
    this.map.ask(this.page.values, across, up);
  }
}
