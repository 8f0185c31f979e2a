// The start page: its map is drawn anew whenever somebody comes to it, from notebooks that were saved just before.

export const START = "course/start.ipynb";

export function keepFresh(lab, app, panel, tracker) {
  if (panel.context.path !== START) return;
  let drawing = false;
  const draw = async () => {
    if (drawing || panel.isDisposed || !panel.isVisible) return;
    drawing = true;
    try {
      await Promise.all([panel.context.ready, panel.sessionContext.ready]);
      const others = tracker.filter((other) => other !== panel && other.context.model.dirty);
      await Promise.all(others.map((other) => other.context.save()));
      await lab.NotebookActions.runCells(panel.content, panel.content.widgets, panel.sessionContext);
    } finally {
      drawing = false;
    }
  };
  // What it shows is nobody's work: the file stays as it came, and an update of the course finds it so.
  panel.context.ready.then(() => panel.context.model.stateChanged.connect((model, { name, newValue }) => {
    if (name === "dirty" && newValue) model.dirty = false;
  }));
  panel.revealed?.then(draw);
  const come = (_, { newValue }) => { if (newValue === panel) draw(); };
  app.shell.currentChanged?.connect(come);
  panel.disposed.connect(() => app.shell.currentChanged?.disconnect(come));
}
