// Runs a cell even if the kernel is still starting. JupyterLab by default would prompt for a kernel or drop the request.

export function waitingExecutor(lab) {
  return {
    id: "ros2-course:cell-executor",
    description: "Runs a cell as soon as its kernel is there. In place of @jupyterlab/notebook-extension:cell-executor.",
    autoStart: true,
    provides: lab.INotebookCellExecutor,
    activate: () => Object.freeze({
      runCell: async (cell) => {
        const context = cell.sessionContext;
        if (cell.cell.model.type === "code" && context && !context.session?.kernel) await context.initialize();
        return lab.runCell(cell);
      },
    }),
  };
}
