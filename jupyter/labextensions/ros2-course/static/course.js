// What the course adds to JupyterLab. Each part is a module; this one hands out the parts of JupyterLab that they use.

import { Dock, robotRenderer, ROBOT } from "./dock.js";
import { Link } from "./link.js";
import { imageRenderer } from "./images.js";
import { patientExecutor } from "./kernels.js";
import { nameTab, ways } from "./tabs.js";
import { keepFresh } from "./start.js";
import { validateButton } from "./validate.js";

const AFTER_RUN_ALL = 9; // place in a notebook's toolbar

export async function plugins(share) {
  const [notebooks, apputils, rendermime, widgets] = await Promise.all(
    ["@jupyterlab/notebook", "@jupyterlab/apputils", "@jupyterlab/rendermime", "@lumino/widgets"].map(share));
  const lab = { ...notebooks, ...apputils, ...rendermime, ...widgets };
  return [patientExecutor(lab), {
    id: "ros2-course:notebooks",
    description: "The robot beside the code, Validate, and the names of the tabs.",
    autoStart: true,
    requires: [lab.INotebookTracker, lab.IRenderMimeRegistry],
    activate: (app, tracker, registry) => {
      const links = new Map();
      const linkOf = (node) => links.get(tracker.find((panel) => panel.node.contains(node)));
      registry.addFactory({
        safe: true, mimeTypes: [ROBOT], createRenderer: () => robotRenderer(lab, (node) => linkOf(node)?.dock),
      }, -100); // before the widget, which the same output holds for other pages
      registry.addFactory({
        safe: true, mimeTypes: ["image/png"], createRenderer: (options) => imageRenderer(lab, options),
      }, 80);
      const adopt = (_, panel) => {
        const dock = new Dock(lab, app, panel);
        const link = new Link(panel, dock);
        links.set(panel, link);
        panel.disposed.connect(() => { links.delete(panel); link.close(); });
        const buttons = [dock.button(), validateButton(lab, app, panel), ...ways(lab, app, panel)];
        buttons.forEach((button, i) => panel.toolbar.insertItem(AFTER_RUN_ALL + i, `ros2-course-${i}`, button));
        nameTab(panel);
        keepFresh(lab, app, panel, tracker);
      };
      tracker.widgetAdded.connect(adopt);
      tracker.forEach((panel) => adopt(null, panel));
      lab.NotebookActions.executionScheduled.connect((_, { notebook }) => {
        for (const [panel, link] of links) if (panel.content === notebook) link.tell();
      });
    },
  }];
}
