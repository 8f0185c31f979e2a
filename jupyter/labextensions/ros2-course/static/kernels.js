// The first press on run works, also before the kernel is there: JupyterLab by itself would ask which kernel to take,
// because it does not know yet which there are, or that one is on its way.

export function startByItself(panel) {
  const context = panel.sessionContext;
  const start = context.startKernel.bind(context);
  let starting;
  context.startKernel = () => starting ??= context.specsManager.ready
    .then(() => (context.session?.kernel ? false : start()))
    .finally(() => { starting = undefined; });
}
