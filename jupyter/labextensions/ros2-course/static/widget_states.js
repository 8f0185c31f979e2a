// The last state of sliders and other widgets. JupyterLab saves those that the kernel has; so a save before their cell
// has run again would drop all others, and the next day nothing would show in their place.

const WIDGETS = "widgets", STATES = "application/vnd.jupyter.widget-state+json";
const NAMED = /"model_id":"([\w-]+)"|IPY_MODEL_([\w-]+)/g; // in an output, and in another widget's state

/** Keep the saved state of each widget that an output still shows, although the kernel doesn't have it. */
export function keepWidgetStates({ context }) {
  context.ready.then(() => {
    const { model } = context;
    let saved = statesIn(model)?.state ?? {};
    model.metadataChanged.connect((_, { key }) => {
      const live = key === WIDGETS && statesIn(model); // which JupyterLab writes as a save begins
      if (!live) return;
      const known = Object.keys(saved).some((id) => !(id in live.state)); // what follows takes time in a long notebook
      const outputs = known ? model.toJSON().cells.map((cell) => cell.outputs ?? []) : [];
      saved = { ...shown(outputs, saved), ...live.state };
      if (Object.keys(saved).length === Object.keys(live.state).length) return;
      model.setMetadata(WIDGETS, { ...model.getMetadata(WIDGETS), [STATES]: { ...live, state: saved } });
    });
  });
}

const statesIn = (model) => model.getMetadata(WIDGETS)?.[STATES];

/** The states of the widgets that these outputs name, and of those that they are made of. */
export function shown(outputs, states) {
  const found = {}, waiting = [outputs];
  while (waiting.length) {
    for (const [, inOutput, inState] of JSON.stringify(waiting.pop()).matchAll(NAMED)) {
      const id = inOutput ?? inState;
      if (!(id in states) || id in found) continue;
      found[id] = states[id];
      waiting.push(states[id]);
    }
  }
  return found;
}
