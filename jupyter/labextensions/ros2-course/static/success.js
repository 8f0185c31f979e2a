// Says what a student has reached: the points of a check to screen readers, and a finished notebook below its last cell.

import { nextNotebook, tabName } from "./tabs.js";
import { checksOf, pointsOf, short } from "./validate.js";

const DONE = 0.9; // fraction of a lesson's cells that counts as done, as on the start page
const CLASS = "ros2-course-success";
const OUTCOME = '<div class="ros2-outcome"';
let region; // one for the page: screen readers announce what changes in a region that they know

/** Let screen readers say a text. */
export function announce(text) {
  region ??= document.body.appendChild(Object.assign(document.createElement("div"), { className: "ros2-course-announcement", role: "status" }));
  if (region.textContent !== text) region.textContent = text;
}

/** After a cell has run: announce its points, and show whether the notebook is done. */
export async function showSuccess(app, panel, cell) {
  const cells = [...panel.content.model.cells].filter((each) => each.type === "code" && each.sharedModel.getSource().trim());
  const checks = checksOf([...panel.content.model.cells]);
  const scores = new Map([...checks].map(([check, { points }]) => [check, earned(check, points)]));
  const check = checks.get(cell);
  const points = check && `${check.name}: ${short(scores.get(cell))} of ${short(check.points)} points.${scores.get(cell) >= check.points ? " Full points." : ""}`;
  const name = /^# ((?:Lesson|Assignment|Bridge) \w+):/m.exec(panel.content.model.cells.get(0).sharedModel.getSource())?.[1];
  const text = name && (checks.size ? passedText(name, checks, scores) : doneText(name, cells));
  announce([points, text].filter(Boolean).join(" "));
  panel.node.querySelector(`.${CLASS}`)?.remove();
  if (!text) return;
  const next = await nextNotebook(app.serviceManager.contents, panel.context.path);
  panel.node.querySelector(`.${CLASS}`)?.remove(); // that of a cell that ran meanwhile
  const line = Object.assign(document.createElement("div"), { className: CLASS, textContent: `✔ ${text} ` });
  if (next) line.append("Next: ", link(app, next));
  panel.content.layout.footer.node.before(line);
}

function link(app, next) {
  const button = Object.assign(document.createElement("button"), { className: "jp-Button", textContent: tabName(next) });
  button.addEventListener("click", () => app.commands.execute("docmanager:open", { path: next }));
  return button;
}

function earned(cell, most) {
  const outputs = cell.outputs.toJSON();
  const result = outputs.find(({ output_type: type }) => type === "execute_result")?.data["text/plain"];
  return cell.executionCount === null ? 0 : pointsOf([result ?? ""].flat().join(""), outputs.some(({ output_type: type }) => type === "error"), most);
}

function passedText(name, checks, scores) {
  const sum = (values) => values.reduce((total, value) => total + value, 0);
  const points = sum([...scores.values()]), most = sum([...checks.values()].map((check) => check.points));
  return points >= most && `${name} passed, ${short(points)} of ${short(most)} points.`;
}

function doneText(name, cells) {
  if (cells.filter((cell) => cell.executionCount !== null).length < DONE * cells.length) return "";
  const pages = cells.flatMap((cell) => cell.outputs.toJSON()).map((output) => [output.data?.["text/html"] ?? ""].flat().join(""));
  const parser = new DOMParser();
  const outcomes = pages.filter((page) => page.startsWith(OUTCOME)).map((page) => parser.parseFromString(page, "text/html").querySelector("div").dataset);
  const right = outcomes.filter(({ happened, predicted }) => happened === predicted).length;
  const made = outcomes.some(({ predicted }) => predicted);
  return `${name} done${made ? `, ${right} of ${outcomes.length} predictions right` : ""}.`;
}
