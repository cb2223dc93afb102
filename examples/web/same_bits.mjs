// The checksums of the program for microcontrollers and of the small bake, computed by the module.

import { readFileSync } from "node:fs";

const page = { is_over: () => 0, rest: () => {} };
const { instance } = await WebAssembly.instantiate(readFileSync("web.wasm"), { page });
const isSame = instance.exports.same_bits() === 1;
console.log(isSame ? "the bits of the host" : "NOT the bits of the host");
process.exit(isSame ? 0 : 1);
