// Saves notebooks one save after another. Two saves of a notebook at the same time end in JupyterLab's dialog
// "File Changed", whose blue button discards all outputs.

const saving = new WeakMap(); // document context: its last save

/** Save a notebook after the save that is under way, if any; resolves when all is saved. */
export function save(context) {
  const { running, waiting } = saving.get(context) ?? {};
  if (waiting) return waiting; // it will save this state, too
  const begin = () => {
    const now = Promise.resolve(context.isDisposed ? undefined : context.save());
    const ended = now.catch(() => {}); // JupyterLab has shown the reason
    saving.set(context, { running: ended });
    return ended;
  };
  if (!running) return begin();
  const next = running.then(begin);
  saving.set(context, { running, waiting: next });
  return next;
}
