"use strict";
// Runs the program of a page outside of a browser: values of sliders in, motions out, as JSON.
const fs = require("fs");
const vm = require("vm");

async function main() {
  const { runtime, program, of, places } = JSON.parse(fs.readFileSync(0, "utf8"));
  vm.runInThisContext(`${runtime}; globalThis.Runner = Runner; globalThis.unpacked = unpacked;`);
  const runner = new Runner(await WebAssembly.compile(await unpacked(program)), of);
  const found = places.map((values) => {
    const outcome = runner.run(values);
    return {
      outcome,
      fate: runner.follow(values),
      readings: Array.from(runner.readings),
      last: Array.from(runner.states.slice(-of.states.length)),
      impacts: runner.readings[2],
      shown: runner.spacing[1],
      placed: Array.from(runner.at(0)),
    };
  });
  process.stdout.write(JSON.stringify(found));
}

main();
