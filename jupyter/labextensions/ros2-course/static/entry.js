// What JupyterLab loads of an extension: here written by hand, so that no tool has to build it. The rest are modules
// that browsers load by themselves; what they need of JupyterLab they get from the parts that all extensions share.

(() => {
  const here = document.currentScript.src;
  let scope;
  const share = async (name) => (await Object.values(scope[name])[0].get())();
  const modules = {
    "./extension": async () => (await import(new URL("course.js", here))).plugins(share),
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
