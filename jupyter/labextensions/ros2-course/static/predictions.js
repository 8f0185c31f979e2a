// Saves clicked predictions, with or without a kernel: in the output of the cell, so that the notebook has them, and in
// predictions.json beside the notebook, where the kernel and the start page find them.

const FILE = "predictions.json";

/** Save what the cards of sim/view/prediction.py report in this notebook. */
export function savePredictions(app, panel) {
  let last = Promise.resolve(); // one write after the other
  panel.node.addEventListener("ros2-prediction", (event) => {
    const { question, answers, letter } = event.detail;
    markOutput(panel, event.target, letter);
    last = last.then(() => writeFile(app.serviceManager.contents, panel.context.path, question, { answers, predicted: letter }));
  });
}

/** Write the letter into the HTML of the output that shows this card. */
function markOutput(panel, card, letter) {
  const cell = panel.content.widgets.find((each) => each.node.contains(card));
  const outputs = cell?.model.outputs;
  for (let index = 0; index < (outputs?.length ?? 0); index++) {
    const output = outputs.get(index), page = output.data["text/html"];
    const text = Array.isArray(page) ? page.join("") : page;
    if (typeof text !== "string" || !text.startsWith('<div class="ros2-prediction"')) continue;
    const marked = text.replace(/ data-predicted="[a-d]?"/, ` data-predicted="${letter}"`);
    output.setData({ data: { ...output.data, "text/html": marked } });
  }
}

async function writeFile(contents, notebook, question, answer) {
  const path = notebook.replace(/[^/]*$/, FILE);
  let saved = {};
  try {
    saved = JSON.parse((await contents.get(path, { format: "text", content: true })).content);
  } catch {
    // the first prediction of this folder
  }
  const on = new Date().toISOString().slice(0, 10);
  const content = `${JSON.stringify({ ...saved, [question]: { ...saved[question], ...answer, on } }, null, 1)}\n`;
  try {
    await contents.save(path, { type: "file", format: "text", content });
  } catch (error) {
    console.warn(`The prediction is saved in the notebook alone: ${error.message ?? error}`);
  }
}
