// The start page: a tab without a notebook and without a kernel. The server makes its content, see
// jupyter/start_page.py; it is loaded again whenever the tab is shown, after unsaved notebooks are saved.

import { save } from "./saving.js";

export const OPEN_START = "ros2-course:open-start";
const ID = "ros2-course-start";
const ADDRESS = "ros2-course/start";
const FOLDER = "http://course/course/"; // links are relative to this folder

/** Adds the command that opens the page; opens it unless the address of JupyterLab is that of a file. */
export function startPage(lab, app, tracker, restorer) {
  const page = new StartPage(lab, app, tracker);
  app.commands.addCommand(OPEN_START, { label: "Start Page of the Course", execute: () => page.open() });
  restorer?.add(page.widget, ID);
  app.shell.currentChanged?.connect((_, { newValue }) => { if (newValue === page.widget) page.refresh(); });
  app.restored.then(() => { if (!lab.PageConfig.getOption("treePath")) page.open(); });
}

class StartPage {
  constructor(lab, app, tracker) {
    this.lab = lab;
    this.app = app;
    this.tracker = tracker;
    this.widget = new lab.Widget();
    this.widget.id = ID;
    this.widget.addClass(ID);
    this.widget.title.label = "Course";
    this.widget.title.closable = true;
    const { node } = this.widget;
    node.tabIndex = -1; // so that it can take the focus, and Tab continues with its first link
    node.setAttribute("role", "region");
    node.setAttribute("aria-label", "Start page");
    node.addEventListener("click", (event) => this.follow(event));
  }

  open() {
    if (!this.widget.isAttached) this.app.shell.add(this.widget, "main", { mode: "tab-before" });
    this.app.shell.activateById(ID);
    if (!this.widget.node.contains(document.activeElement)) this.widget.node.focus({ preventScroll: true });
    return this.refresh();
  }

  /** Load the content; a link that has the focus keeps it. */
  async refresh() {
    if (this.loading) return;
    this.loading = true;
    try {
      const others = this.tracker.filter((other) => other.context.model.dirty && !other.context.model.readOnly);
      await Promise.all(others.map((other) => save(other.context)));
      const { serverSettings } = this.app.serviceManager;
      const response = await this.lab.ServerConnection.makeRequest(serverSettings.baseUrl + ADDRESS, {}, serverSettings);
      this.put(await response.text());
    } catch (error) {
      this.put("");
      this.widget.node.textContent = `The start page could not be loaded: ${error.message ?? error}`;
    } finally {
      this.loading = false;
    }
  }

  put(content) {
    const { node } = this.widget, top = node.scrollTop;
    const focused = node.contains(document.activeElement) && document.activeElement.getAttribute("href");
    node.innerHTML = content;
    node.scrollTop = top;
    if (focused) [...node.querySelectorAll("a")].find((link) => link.getAttribute("href") === focused)?.focus();
  }

  /** Open what a link leads to in JupyterLab, unless it leads out of the course. */
  follow(event) {
    const link = event.target.closest?.("a[href]");
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
    const target = new URL(link.getAttribute("href"), FOLDER);
    if (target.origin !== new URL(FOLDER).origin) return;
    event.preventDefault();
    this.app.commands.execute("docmanager:open", { path: decodeURIComponent(target.pathname.slice(1)) });
  }
}
