// Validate: runs the notebook from top to bottom in a separate kernel, without affecting the student's kernel, and shows
// the points of each exercise as soon as they are available.

import { save } from "./saving.js";

const HEADING = /^#+\s*(.+?)\s*(?:\([\d.]+ points?\))?\s*$/m;
const LIMIT = 60; // s for a cell when a class is marked: c.Execute.timeout of nbgrader_config.py
const WIDTH = "min(80vw, 720px)";

export function validateButton(lab, app, panel) {
  return new lab.ToolbarButton({
    className: "validate-button", label: "Validate", tooltip: "Run everything in a new kernel and show the points",
    onClick: () => validate(lab, app, panel),
  });
}

async function validate(lab, app, panel) {
  const table = new Table(lab);
  const cells = [...panel.content.model.cells];
  const checks = checksOf(cells);
  const tests = checks.size;
  for (const [cell, { name, points }] of checks) table.wait(cell, name, points);
  save(panel.context);
  table.setStatus(tests ? "Running the notebook in a new kernel ..." : "This notebook has no checks to run.");
  const closed = lab.showDialog({
    title: "Validation Results", body: table.widget, buttons: [lab.Dialog.okButton({ label: "Close" })],
  });
  if (!tests) return;
  const name = panel.sessionContext.session?.kernel?.name ?? "python3";
  const kernel = await app.serviceManager.kernels.startNew({ name, path: panel.context.localPath });
  let open = true;
  closed.then(() => { open = false; kernel.shutdown(); });
  try {
    await runCells(kernel, cells, checks, table, () => open);
  } catch (error) {
    if (open) table.setStatus(`The notebook could not be run to its end: ${error.message ?? error}`);
  } finally {
    table.stopClock();
    if (open) await kernel.shutdown();
  }
}

/** The cells with a check, each with the heading above it and its points. */
export function checksOf(cells) {
  const checks = new Map();
  let heading = "";
  for (const cell of cells) {
    const text = cell.sharedModel.getSource();
    if (cell.type === "markdown") heading = HEADING.exec(text)?.[1] ?? heading;
    const grading = cell.getMetadata("nbgrader");
    if (cell.type === "code" && text.trim() && grading?.grade) checks.set(cell, { name: heading, points: Number(grading.points) });
  }
  return checks;
}

async function runCells(kernel, cells, checks, table, open) {
  let number = 0, count = 0;
  for (const cell of cells) {
    const text = cell.sharedModel.getSource();
    if (cell.type !== "code" || !text.trim()) continue;
    const check = checks.get(cell);
    count += 1;
    table.begin(cell, check ? `Check ${++number} of ${checks.size}: ${check.name}` : `Cell [${count}]: ${text.trim().split("\n")[0]}`);
    const { result, error } = await execute(kernel, text, cell.id);
    if (!open()) return;
    if (check) table.finish(cell, result, error);
  }
  table.showTotal();
  table.setStatus("");
  table.since.textContent = "";
}

/** Run code; returns its result as text, and its error in one line. */
async function execute(kernel, code, cellId) {
  const future = kernel.requestExecute({ code, stop_on_error: false, allow_stdin: false }, true, { cellId });
  let result, error = "";
  future.onIOPub = ({ header, content }) => {
    if (header.msg_type === "execute_result") result ??= content.data["text/plain"];
    if (header.msg_type === "error") error ||= `${content.ename}: ${content.evalue}`;
  };
  await future.done;
  return { result, error };
}

/** The table of checks: all rows from the beginning, results as they arrive, and the total at the end. */
class Table {
  constructor(lab) {
    this.body = document.createElement("tbody");
    this.foot = document.createElement("tfoot");
    this.rows = new Map();
    this.status = Object.assign(document.createElement("p"), { role: "status" });
    const table = document.createElement("table"), head = document.createElement("thead");
    head.append(row("th", ["Exercise", "Points", ""]));
    for (const cell of head.querySelectorAll("th")) cell.scope = "col";
    table.append(Object.assign(document.createElement("caption"), { textContent: "Points of each check" }), head, this.body, this.foot);
    table.className = "ros2-course-points";
    table.style.width = WIDTH;
    this.widget = new lab.Widget();
    this.since = Object.assign(document.createElement("p"), { ariaHidden: "true" }); // not announced each second
    this.widget.node.append(table, this.status, this.since);
    this.earned = this.most = 0;
  }

  setStatus(text) {
    this.status.textContent = text;
  }

  wait(cell, name, most) {
    const line = row("td", [name, `– of ${short(most)}`, "waits"]);
    this.rows.set(cell, { line, name, most });
    this.body.append(line);
  }

  /** Show which cell runs, and for how long: a check with many runs may take a minute. */
  begin(cell, text) {
    const began = performance.now(), place = this.rows.get(cell)?.line.lastChild ?? this.since;
    this.setStatus(`${text} ...`);
    this.since.textContent = "";
    const show = () => {
      const seconds = Math.floor((performance.now() - began) / 1000);
      place.textContent = `runs, ${seconds} s`;
      if (seconds === LIMIT) this.setStatus(`${text} ... When it is marked, a cell is stopped after ${LIMIT} s, and what comes after it may fail.`);
    };
    show();
    this.stopClock();
    this.clock = setInterval(show, 1000);
  }

  stopClock() {
    clearInterval(this.clock);
  }

  finish(cell, result, error) {
    this.stopClock();
    const { line, name, most } = this.rows.get(cell);
    const points = pointsOf(result, error, most);
    this.earned += points;
    this.most += most;
    const note = error || (points >= most ? "✔" : points ? "in part: run its check to see why" : "run its check to see why");
    line.replaceChildren(...row("td", [name, `${short(points)} of ${short(most)}`, note]).children);
  }

  showTotal() {
    this.foot.replaceChildren(row("th", ["Total", `${short(this.earned)} of ${short(this.most)}`, ""]));
  }
}

/** The points of a check, as in nbgrader: a number is the points, an error gives none, and a check without either gives all. */
export function pointsOf(result, error, most) {
  const value = /^-?\d+(\.\d+)?$/.test(result ?? "") ? Number(result) : error ? 0 : most;
  return Math.min(Math.max(value, 0), most);
}

export const short = (points) => String(Math.round(points * 100) / 100);

function row(kind, texts) {
  const line = document.createElement("tr");
  for (const text of texts) {
    const cell = document.createElement(kind);
    // Text between backticks is code.
    cell.append(...text.split(/`([^`]+)`/).map((part, index) => (index % 2 ? Object.assign(document.createElement("code"), { textContent: part }) : part)));
    line.append(cell);
  }
  return line;
}
