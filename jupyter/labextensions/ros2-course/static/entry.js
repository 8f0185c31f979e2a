// The entry point that JupyterLab loads, written by hand so that no build tool is needed. The rest are modules that
// browsers load directly; they access JupyterLab through the modules that all extensions share.

(() => {
  const here = /** @type {HTMLScriptElement} */ (document.currentScript).src;
  let scope;
  const share = async (name) => (await Object.values(scope[name])[0].get())();
  const modules = {
    "./extension": async () => (await import(new URL("course.js", here).href)).plugins(share),
    "./style": async () => {
      document.head.append(Object.assign(document.createElement("link"), {
        rel: "stylesheet", href: new URL("course.css", here),
      }));
    },
  };
  (window._JUPYTERLAB ??= {})["ros2-course"] = {
    init: (shared) => { scope = shared; },
    get: async (name) => {
      const content = await modules[name]();
      return () => ({ __esModule: true, default: content });
    },
  };
})();
