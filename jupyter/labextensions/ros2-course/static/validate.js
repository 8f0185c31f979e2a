// Validate: runs the notebook from top to bottom in a separate kernel, without affecting the student's kernel, and shows
// the points of each exercise as soon as they are available.

const HEADING = /^#+\s*(.+?)\s*(?:\([\d.]+ points?\))?\s*$/m;
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
  const tests = cells.filter((cell) => cell.getMetadata("nbgrader")?.grade).length;
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
    await runCells(kernel, cells, table, () => open);
  } catch (error) {
    if (open) table.setStatus(`The notebook could not be run to its end: ${error.message ?? error}`);
  } finally {
    if (open) await kernel.shutdown();
  }
}

async function runCells(kernel, cells, table, open) {
  let heading = "";
  for (const cell of cells) {
    const text = cell.sharedModel.getSource();
    if (cell.type === "markdown") heading = HEADING.exec(text)?.[1] ?? heading;
    if (cell.type !== "code" || !text.trim()) continue;
    const grading = cell.getMetadata("nbgrader");
    const { result, error } = await execute(kernel, text, cell.id);
    if (!open()) return;
    if (grading?.grade) table.add(heading, result, Number(grading.points), error);
  }
  table.setStatus("");
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

class Table {
  constructor(lab) {
    this.body = document.createElement("tbody");
    this.total = row("th", ["Total", "0", ""]);
    this.status = Object.assign(document.createElement("p"), { role: "status" });
    const table = document.createElement("table"), head = document.createElement("thead"), foot = document.createElement("tfoot");
    head.append(row("th", ["Exercise", "Points", ""]));
    foot.append(this.total);
    table.append(head, this.body, foot);
    table.className = "ros2-course-points";
    table.style.width = WIDTH;
    this.widget = new lab.Widget();
    this.widget.node.append(table, this.status);
    this.earned = this.most = 0;
  }

  setStatus(text) {
    this.status.textContent = text;
  }

  add(name, result, most, error) {
    // As in nbgrader: a number is the points, an error gives none, and a check without either gives all.
    const value = /^-?\d+(\.\d+)?$/.test(result ?? "") ? Number(result) : error ? 0 : most;
    const points = Math.min(Math.max(value, 0), most);
    this.earned += points;
    this.most += most;
    const note = error || (points >= most ? "✔" : points ? "in part: run its check to see why" : "run its check to see why");
    this.body.append(row("td", [name, `${short(points)} of ${short(most)}`, note]));
    this.total.replaceChildren(...row("th", ["Total", `${short(this.earned)} of ${short(this.most)}`, ""]).children);
  }
}

const short = (points) => String(Math.round(points * 100) / 100);

function row(kind, texts) {
  const line = document.createElement("tr");
  for (const text of texts) line.append(Object.assign(document.createElement(kind), { textContent: text }));
  return line;
}
