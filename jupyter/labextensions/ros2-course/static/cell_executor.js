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
        // Not initialize(): before the notebook's metadata is read, that would ask which kernel is meant.
        if (cell.cell.model.type === "code" && context && !context.session?.kernel) await context.ready;
        return lab.runCell(cell);
      },
    }),
  };
}
