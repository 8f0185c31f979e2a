// Distinct tab names, because all lessons have the same file name; and buttons to the map and the next notebook.

import { OPEN_START } from "./start.js";

const FILE = /^(?:.*\/)?(course|exercises)\/(\d\d)_(\w+)\/(\w+)\.ipynb$/;

export function tabName(path) {
  const [, , number, topic, file] = FILE.exec(path) ?? [];
  if (!number) return "";
  const subject = topic[0].toUpperCase() + topic.slice(1).replaceAll("_", " ");
  return `${Number(number)} ${subject}: ${file === "lesson" ? "lesson" : "exercises"}`;
}

export function renameTab(panel) {
  // JupyterLab renames the file when the title changes, so its handler must be disconnected.
  if (!panel._onTitleChanged || !panel.title.changed.disconnect(panel._onTitleChanged, panel)) return;
  const name = () => {
    const label = tabName(panel.context.path);
    if (label && panel.title.label !== label) panel.title.label = label;
  };
  name();
  panel.context.ready.then(name);
  panel.title.changed.connect(name); // JupyterLab sets the title to the file's name, initially and after a rename
}

/** The next notebook: a lesson's exercises, then the next lesson; undefined after the last. */
async function nextNotebook(contents, path) {
  const [, folder, number, topic] = FILE.exec(path) ?? [];
  if (!number) return undefined;
  const first = async (folder) => {
    const { content } = await contents.get(folder).catch(() => ({ content: [] }));
    return content.find(({ type }) => type === "notebook")?.path;
  };
  const own = folder === "course" ? await first(`exercises/${number}_${topic}`) : undefined;
  if (own) return own;
  const { content } = await contents.get("course");
  const later = content.filter(({ type, name }) => type === "directory" && /^\d\d_/.test(name) && name.slice(0, 2) > number);
  const next = later.map((each) => each.path).sort()[0];
  return next && first(next);
}

/** Buttons for a notebook's toolbar: to the course map, and to the next notebook. */
export function navigationButtons(lab, app, panel) {
  const open = (path) => app.commands.execute("docmanager:open", { path });
  const button = (label, tooltip, onClick) => new lab.ToolbarButton({ label, tooltip, onClick });
  if (!FILE.test(panel.context.path)) return [];
  return [
    button("Course", "Back to the start page of the course", () => app.commands.execute(OPEN_START)),
    button("Next", "On to the notebook that comes next", async () => {
      const next = await nextNotebook(app.serviceManager.contents, panel.context.path);
      return next ? open(next) : app.commands.execute(OPEN_START);
    }),
  ];
}
