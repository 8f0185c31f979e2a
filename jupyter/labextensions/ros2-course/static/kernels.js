// The first press on run works, also before the kernel is there: JupyterLab by itself would ask which kernel to take,
// because it does not know yet which there are.

const PATIENCE = 60_000; // ms

export function startByItself(panel) {
  const context = panel.sessionContext;
  const start = context.startKernel.bind(context);
  context.startKernel = async () => {
    // JupyterLab is starting one already, unless the user has shut it down.
    await Promise.race([context.ready, new Promise((done) => setTimeout(done, PATIENCE))]);
    return context.session?.kernel ? false : start();
  };
}
