// Distinct tab names, because all lessons have the same file name; and buttons to the map and the next notebook.

import { OPEN_START } from "./start.js";

// 11b_launching is another assignment of lesson 11.
const FILE = /^(?:.*\/)?(course|exercises)\/(\d\d)([a-z]?)_(\w+)\/(\w+)\.ipynb$/;
const PAGE = /^(?:.*\/)?(course\/bridge)\/(\d\d)_(\w+)\.ipynb$/; // after the lessons

export function tabName(path) {
  const [, , page, about] = PAGE.exec(path) ?? [];
  if (page) return `B${Number(page)} ${subjectOf(about)}`;
  const [, folder, number, letter, topic, file] = FILE.exec(path) ?? [];
  if (!number) return "";
  return `${Number(number)}${letter} ${subjectOf(topic)}: ${folder === "course" ? file : "exercises"}`;
}

const subjectOf = (name) => name[0].toUpperCase() + name.slice(1).replaceAll("_", " ");

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

/** The next notebook: the lesson's other one, its assignments, then the next lesson or page; undefined after the last. */
export async function nextNotebook(contents, path) {
  const [, bridge] = PAGE.exec(path) ?? [];
  if (bridge) {
    const { content } = await contents.get(bridge);
    const pages = content.map((each) => each.path).filter((each) => PAGE.test(each)).sort();
    return pages[pages.indexOf(path) + 1];
  }
  const [, folder, number, letter, topic, file] = FILE.exec(path) ?? [];
  if (!number) return undefined;
  const own = `${number}${letter}_${topic}`;
  const notebooks = async (folder) => {
    const { content } = await contents.get(folder).catch(() => ({ content: [] }));
    const names = content.filter(({ type }) => type === "notebook").map(({ name }) => name);
    const first = names.filter((name) => name === "lesson.ipynb");
    return [...first, ...names.filter((name) => name !== "lesson.ipynb").sort()].map((name) => `${folder}/${name}`);
  };
  if (folder === "course") {
    const both = (await notebooks(`course/${own}`)).filter((each) => !each.endsWith("-new.ipynb"));
    const later = both.slice(both.findIndex((each) => each.endsWith(`/${file}.ipynb`)) + 1);
    const [next] = [...later, ...(await notebooks(`exercises/${own}`))];
    if (next) return next;
  }
  const folders = async (parent, isNext) => {
    const { content } = await contents.get(parent);
    const found = content.filter(({ type, name }) => type === "directory" && /^\d\d[a-z]?_/.test(name) && isNext(name));
    return found.map((each) => each.path).sort();
  };
  const [other] = folder === "exercises" ? await folders(folder, (name) => name.startsWith(number) && name > own) : [];
  const [following] = other ? [other] : await folders("course", (name) => name.slice(0, 2) > number);
  return following && (await notebooks(following))[0];
}

/** Buttons for a notebook's toolbar: to the course map, and to the next notebook. */
export function navigationButtons(lab, app, panel) {
  const open = (path) => app.commands.execute("docmanager:open", { path });
  const button = (label, tooltip, onClick) => new lab.ToolbarButton({ label, tooltip, onClick });
  if (!FILE.test(panel.context.path) && !PAGE.test(panel.context.path)) return [];
  return [
    button("Course", "Back to the start page of the course", () => app.commands.execute(OPEN_START)),
    button("Next", "Go to the next notebook", async () => {
      const next = await nextNotebook(app.serviceManager.contents, panel.context.path);
      return next ? open(next) : app.commands.execute(OPEN_START);
    }),
  ];
}
