// The pairs of a ZIP that Dolos finds most alike, as JSON: node dolos_pairs.mjs FOLDER ZIP COUNT
// FOLDER: where `npm install @dodona/dolos-lib` was run.
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, zip, count] = process.argv.slice(2);
const found = createRequire(join(folder, "package.json")).resolve("@dodona/dolos-lib");
const { Dolos } = await import(pathToFileURL(found));
const report = await new Dolos().analyzePaths([zip]);
const pairs = report.allPairs().sort((one, other) => other.similarity - one.similarity);
const name = (file) => file.extra?.fullName ?? file.path;
const rows = pairs.slice(0, Number(count)).map((pair) => [name(pair.leftFile), name(pair.rightFile), pair.similarity]);
console.log(JSON.stringify({ files: report.files.length, warnings: report.warnings, rows }));
