// The first press on run works, also before the kernel is there. JupyterLab by itself would ask which kernel to take, as
// it doesn't know yet that one is on its way, or would forget the press.

export function patientExecutor(lab) {
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
