// Tabs with names that differ: each lesson is a file of the same name.

const FILE = /(?:^|\/)(\d\d)_(\w+)\/(\w+)\.ipynb$/;

export function tabName(path) {
  const found = FILE.exec(path);
  if (!found) return "";
  const [, number, topic, file] = found;
  const subject = topic[0].toUpperCase() + topic.slice(1).replaceAll("_", " ");
  return `${Number(number)} ${subject}: ${file === "lesson" ? "lesson" : "exercises"}`;
}

export function nameTab(panel) {
  const name = () => {
    const label = tabName(panel.context.path);
    if (label && panel.title.label !== label) panel.title.label = label;
  };
  name();
  panel.context.ready.then(name);
  panel.title.changed.connect(name); // JupyterLab sets the file's name, at first and whenever it changes
}
