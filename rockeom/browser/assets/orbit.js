"use strict";
// The viewer of a structure in space, whom a drag, the arrow keys and plus and minus move around it.

/** Where the viewer is at first: azimuth and elevation [rad]. */
const VIEW = [-1.13, 0.33];
/** By how much a key turns the view [rad], and by which factor it zooms. */
const TURN_OF_KEY = Math.PI / 36;
const ZOOM_OF_KEY = 1.25;

class Orbit {
  /** @param {HTMLCanvasElement} canvas @param {() => void} changed */
  constructor(canvas, changed) {
    this.canvas = canvas;
    this.changed = changed;
    this.view = [...VIEW];
    this.zoom = 1;
    canvas.style.touchAction = "none";
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    this.followPointer();
    this.followKeys();
  }

  followPointer() {
    const { canvas } = this;
    let last = [0, 0];
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      last = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointermove", ({ buttons, clientX, clientY }) => {
      if (buttons) this.turn(0.01 * (last[0] - clientX), 0.01 * (clientY - last[1]));
      last = [clientX, clientY];
    });
  }

  followKeys() {
    this.canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      const zoom = { "+": ZOOM_OF_KEY, "-": 1 / ZOOM_OF_KEY }[event.key];
      if (!step && !zoom && event.key !== "Home") return;
      event.preventDefault();
      if (event.key === "Home") [this.view, this.zoom] = [[...VIEW], 1];
      this.zoom = within(this.zoom * (zoom ?? 1), { low: 0.25, high: 8 });
      const [across, up] = step ?? [0, 0];
      this.turn(across * TURN_OF_KEY, up * TURN_OF_KEY);
    });
  }

  /** @param {number} around @param {number} up */
  turn(around, up) {
    this.view[0] += around;
    this.view[1] = within(this.view[1] + up, { low: 0, high: Math.PI / 2 });
    this.changed();
  }

  /** Directions to the right, upwards and towards the viewer. */
  directions() {
    const [[ca, ce], [sa, se]] = [this.view.map(Math.cos), this.view.map(Math.sin)];
    return [
      [-sa, ca, 0],
      [-se * ca, -se * sa, ce],
      [ce * ca, ce * sa, se],
    ];
  }
}
