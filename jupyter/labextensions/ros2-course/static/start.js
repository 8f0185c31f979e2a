// Refreshes the course map of the start page whenever it is shown; other notebooks are saved first.

export const START = "course/start.ipynb";

export function refreshStartPage(lab, app, panel, tracker) {
  if (panel.context.path !== START) return;
  let refreshing = false;
  const refresh = async () => {
    if (refreshing || panel.isDisposed || !panel.isVisible) return;
    refreshing = true;
    try {
      await Promise.all([panel.context.ready, panel.sessionContext.ready]);
      const others = tracker.filter((other) => other !== panel && other.context.model.dirty);
      await Promise.all(others.map((other) => other.context.save()));
      await lab.NotebookActions.runCells(panel.content, panel.content.widgets, panel.sessionContext);
    } finally {
      refreshing = false;
    }
  };
  // The outputs are not the user's work: the file stays unmodified, so that a course update can replace it.
  panel.context.ready.then(() => panel.context.model.stateChanged.connect((model, { name, newValue }) => {
    if (name === "dirty" && newValue) model.dirty = false;
  }));
  panel.revealed?.then(refresh);
  const onShow = (_, { newValue }) => { if (newValue === panel) refresh(); };
  app.shell.currentChanged?.connect(onShow);
  panel.disposed.connect(() => app.shell.currentChanged?.disconnect(onShow));
}
