// The course's JupyterLab extension. Each feature is a module; this one passes JupyterLab's shared modules to them.

import { KernelComm } from "./kernel_comm.js";
import { RobotPanel, RobotSidebar, robotRenderer, ROBOT } from "./robot_panel.js";
import { imageRenderer } from "./images.js";
import { waitingExecutor } from "./cell_executor.js";
import { savePredictions } from "./predictions.js";
import { save } from "./saving.js";
import { navigationButtons, renameTab } from "./tabs.js";
import { startPage } from "./start.js";
import { showSuccess } from "./success.js";
import { validateButton } from "./validate.js";
import { keepWidgetStates } from "./widget_states.js";

const AFTER_RUN_ALL = 9; // index in a notebook's toolbar

export async function plugins(share) {
  const [notebooks, apputils, rendermime, widgets, { LabIcon }, { ILayoutRestorer }, { PageConfig }, { ServerConnection }] =
    await Promise.all([
      "@jupyterlab/notebook", "@jupyterlab/apputils", "@jupyterlab/rendermime", "@lumino/widgets", "@jupyterlab/ui-components",
      "@jupyterlab/application", "@jupyterlab/coreutils", "@jupyterlab/services",
    ].map(share));
  const lab = { ...notebooks, ...apputils, ...rendermime, ...widgets, LabIcon, ILayoutRestorer, PageConfig, ServerConnection };
  return [waitingExecutor(lab), {
    id: "ros2-course:notebooks",
    description: "The robot beside the code, Validate, and the names of the tabs.",
    autoStart: true,
    requires: [lab.INotebookTracker, lab.IRenderMimeRegistry],
    optional: [lab.ILayoutRestorer],
    activate: (app, tracker, registry, restorer) => {
      startPage(lab, app, tracker, restorer);
      const comms = new Map();
      const sidebar = new RobotSidebar(lab, app, tracker);
      // An output may also have a view of its own, outside its notebook.
      const commOf = (node, model) => comms.get(tracker.find((panel) => panel.node.contains(node)))
        ?? [...comms.values()].find((comm) => comm.robotPanel.plays(model));
      registry.addFactory({
        safe: true, mimeTypes: [ROBOT], createRenderer: () => robotRenderer(lab, (node, model) => commOf(node, model)?.robotPanel),
      }, -100); // before the widget in the same output, which is for other pages
      registry.addFactory({
        safe: true, mimeTypes: ["image/png"], createRenderer: (options) => imageRenderer(lab, options),
      }, 80);
      const extend = (_, panel) => {
        const robotPanel = new RobotPanel(lab, sidebar, panel);
        const comm = new KernelComm(panel, robotPanel);
        comms.set(panel, comm);
        panel.disposed.connect(() => { comms.delete(panel); comm.close(); });
        const buttons = [robotPanel.button(), validateButton(lab, app, panel), ...navigationButtons(lab, app, panel)];
        buttons.forEach((button, i) => panel.toolbar.insertItem(AFTER_RUN_ALL + i, `ros2-course-${i}`, button));
        renameTab(panel);
        savePredictions(app, panel);
        keepWidgetStates(panel);
      };
      tracker.widgetAdded.connect(extend);
      tracker.forEach((panel) => extend(null, panel));
      lab.NotebookActions.executionScheduled.connect((_, { notebook }) => {
        for (const [panel, comm] of comms) if (panel.content === notebook) comm.sendCells();
      });
      // The start page shows the points of the saved notebook.
      lab.NotebookActions.executed.connect((_, { notebook, cell }) => {
        const panel = [...comms.keys()].find((each) => each.content === notebook);
        if (!panel) return;
        if (cell.model.getMetadata("nbgrader")?.grade) save(panel.context);
        showSuccess(app, panel, cell.model);
      });
    },
  }];
}
