"use strict";
// Functions of the scripts of a page that need no page: `node --test`.
const assert = require("node:assert/strict");
const fs = require("fs");
const path = require("path");
const test = require("node:test");
const vm = require("vm");

const ASSETS = path.join(__dirname, "../../rockeom/browser/assets");
const scripts = ["texts", "views", "panel", "address", "lesson", "map", "surface", "charts", "lean"];
const context = vm.createContext({ self: {}, URLSearchParams });
const names =
  "Lean, Surface, accept, covers, few, fill, hull, kindOf, lowest, named, quantity, roundStep, short, ticks, truth, within";
const text = scripts.map((name) => fs.readFileSync(path.join(ASSETS, `${name}.js`), "utf8")).join("\n");
const {
  Lean,
  Surface,
  accept,
  covers,
  few,
  fill,
  hull,
  kindOf,
  lowest,
  named,
  quantity,
  roundStep,
  short,
  ticks,
  truth,
} = vm.runInContext(`${text}; ({ ${names} })`, context);
const plain = (value) => JSON.parse(JSON.stringify(value));

function page() {
  const inputs = [
    { name: "width", low: 0.1, high: 0.4, unit: "m" },
    { name: "law", low: 0, high: 1, options: ["Housner", "r = 0.8"] },
  ];
  return { inputs, values: [0.2, 0], note: "" };
}

test("values from outside are taken by name, and options by label", () => {
  const at = page();
  accept(at, "The address", [
    ["width", "0.3"],
    ["law", "r = 0.8"],
  ]);
  assert.deepEqual(plain([at.values, at.note]), [[0.3, 1], ""]);
  assert.deepEqual(plain(named(at)), { width: 0.3, law: "r = 0.8" });
});

test("a value outside of the slider is put to its end, which is said", () => {
  const at = page();
  accept(at, "The address", [["width", "7"]]);
  assert.equal(at.values[0], 0.4);
  assert.match(at.note, /gives 7 for 'width', outside of the slider: 0.4 is taken/);
});

for (const value of ["NaN", "Infinity", "-Infinity", "", " ", "0x", "1e999", "0.2; alert(1)", null, {}]) {
  test(`${JSON.stringify(value)} is no number, and leaves the value`, () => {
    const at = page();
    accept(at, "The address", [["width", value]]);
    assert.equal(at.values[0], 0.2);
    assert.match(at.note, /no finite number/);
  });
}

for (const name of ["height", "__proto__", "constructor", ""]) {
  test(`the name '${name}', which the page has not, is said and leaves all values`, () => {
    const at = page();
    accept(at, "The address", [[name, "0.3"]]);
    assert.deepEqual(plain(at.values), [0.2, 0]);
    assert.match(at.note, /which this page does not have/);
  });
}

test("an option that a menu has not is said", () => {
  const at = page();
  accept(at, "The address", [["law", "2"]]);
  assert.equal(at.values[1], 0);
  assert.match(at.note, /none of its options/);
});

test("a prediction is judged within one percent", () => {
  assert.deepEqual(
    [truth("peak", 1, 1.009), truth("peak", 1, 1.02), truth("peak", 1, 0.98), truth("overturns", 0, 1)],
    ["same", "grows", "falls", "yes"],
  );
});

test("outcomes are three kinds of cells", () => {
  const outcomes = ["completed", "came to rest", "overturned", "chatter", undefined];
  assert.deepEqual(outcomes.map(kindOf), [0, 0, 1, 2, 2]);
});

test("numbers have few digits, and their units", () => {
  assert.deepEqual([few(0.12345), few(0), few(12345), few(NaN)], ["0.123", "0", "1.23e+4", "NaN"]);
  assert.deepEqual([short(100000), short(0.25)], ["1e5", "0.25"]);
  assert.equal(quantity(9.80665, "m/s2"), "9.81 m/s² (1 g)");
  assert.equal(quantity(Math.PI, "rad"), "3.14 rad (180°)");
  assert.equal(fill("{0} of {1} {2}", 1, 2), "1 of 2 {2}");
});

test("ticks and steps are round", () => {
  assert.deepEqual(plain(ticks([-0.3, 0.3], 3)), [-0.2, 0, 0.2]);
  assert.equal(roundStep(0.35), 0.001);
});

// a box of 2 by 4 by 6 m about its centroid, faces counter-clockwise from outside
const BOX = [-1, 1].flatMap((z) =>
  [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].map(([x, y]) => [x, 2 * y, 3 * z]),
);
const SIDES = [0, 1, 2, 3].map((i) => [i, (i + 1) % 4, 4 + ((i + 1) % 4), 4 + i]);
const FACES = [...SIDES, [3, 2, 1, 0], [4, 5, 6, 7]];

test("faces of a box look outward, and all its edges are creases", () => {
  const solid = { place: 0, vertices: 8, faces: 6, corners: 4, at: -1 };
  const surface = new Surface(solid, Float64Array.from(BOX.flat()), Uint16Array.from(FACES.flat()));
  surface.shape();
  assert.deepEqual(plain(surface.normals), [
    [0, -1, 0],
    [1, 0, 0],
    [0, 1, 0],
    [-1, 0, 0],
    [0, 0, -1],
    [0, 0, 1],
  ]);
  assert.equal(surface.edges.length, 12);
  assert.ok(surface.edges.every(({ sharp, of }) => sharp && of.length === 2));
  assert.deepEqual(plain(lowest(surface.points)), BOX.slice(0, 4));
});

test("the hull of points seen from above goes around them, without those within", () => {
  const around = hull([...BOX, [0, 0, 0], [0.5, -1, 0]]).map(([x, y]) => [x, y]);
  assert.deepEqual(plain(around), [
    [-1, -2],
    [1, -2],
    [1, 2],
    [-1, 2],
  ]);
});

test("a face covers what is behind it, not what is before or beside it", () => {
  const points = [
    [0, 10],
    [10, 10],
    [10, 0],
    [0, 0],
  ]; // the picture has y downwards
  const face = { points, depths: [1, 3, 3, 1] };
  assert.equal(covers(face, [5, 5], 1.9), true);
  assert.equal(covers(face, [5, 5], 2.1), false);
  assert.equal(covers(face, [12, 5], 0), false);
});

test("a body overturns where its centroid is above the farthest foot, a round one at one tilt", () => {
  const space = { round: false };
  const lean = new Lean({ runner: { of: { space } } });
  const [b, c, h] = [0.25, 0.35, 1.5];
  lean.arms = [-1, 1].flatMap((x) => [-1, 1].map((y) => [x * b, y * c, -h]));
  for (const d of [0, 0.7, 2, 4, 5.5]) {
    const right = Math.atan((b * Math.abs(Math.cos(d)) + c * Math.abs(Math.sin(d))) / h);
    assert.ok(Math.abs(lean.barrier(Math.cos(d), Math.sin(d)) - right) < 1e-15);
  }
  space.round = true;
  assert.ok(Math.abs(lean.barrier(1, 0) - Math.atan(Math.hypot(b, c) / h)) < 1e-15);
  space.round = false; // over the outer foot, which is higher, and over the inner one, which is not
  lean.arms = [
    [0.2, 0, -0.6],
    [0.35, 0, -0.58],
    [-0.3, 0.2, -0.6],
    [0.3, -0.2, -0.6],
    [-0.4, 0, -0.1],
  ];
  assert.equal(lean.barrier(1, 0), Math.atan(0.35 / 0.58));
  assert.equal(lean.barrier(-1, 0), Math.atan(0.3 / 0.6));
});
