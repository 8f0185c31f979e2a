// Evaluates scripts of ../../sim/view/web in one scope, as a page does, and returns the values of some of their names.

import { readFileSync } from "node:fs";

/** @param {string[]} files without .js, in the order of the page @param {string[]} names */
export function load(files, names) {
  const texts = files.map((file) => readFileSync(new URL(`../../sim/view/web/${file}.js`, import.meta.url), "utf8"));
  return new Function(`"use strict";\n${texts.join("\n")}\nreturn { ${names.join(", ")} };`)();
}
