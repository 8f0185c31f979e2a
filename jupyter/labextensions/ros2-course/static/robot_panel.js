// The robot of the active notebook, in JupyterLab's right sidebar: the live view, and the replay after the run.

import { announce } from "./success.js";

export const ROBOT = "application/vnd.ros2-course.robot+json";
const WIDGET = "application/vnd.jupyter.widget-view+json";
const ID = "ros2-course-robot";
const NARROW = 1000; // px; in a narrower window the left sidebar gives way to the robot
const SHARE = 0.38, NARROW_SHARE = 0.5, MOST_SHARE = 0.6; // of the window's width, when the sidebar opens
const NONE = "No robot plays yet. Run a cell with play(...), and it drives here.";
const RESTARTED = "The kernel was restarted, and the robot is gone. Run the cells again, and it drives here.";
const ICON = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><g class="jp-icon3" fill="#616161">'
  + '<path d="M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zm0 2a7 7 0 1 1 0 14 7 7 0 0 1 0-14z"/><path d="M9.5 7.5l7 4.5-7 4.5 1.8-4.5z"/></g></svg>';

/** The one sidebar; it shows the robot of the active notebook. */
export class RobotSidebar {
  constructor(lab, app, tracker) {
    this.lab = lab;
    this.app = app;
    this.tracker = tracker;
    this.robots = new Map(); // by notebook panel
    this.opened = false;
    this.widget = new lab.StackedPanel();
    this.widget.id = ID;
    this.widget.addClass("ros2-course-robots");
    this.widget.title.caption = "Robot";
    this.widget.title.icon = new lab.LabIcon({ name: "ros2-course:robot", svgstr: ICON });
    app.shell.add(this.widget, "right", { rank: 50 });
    tracker.currentChanged.connect(() => this.follow());
    let before = Infinity; // px; the window has no width yet
    window.addEventListener("resize", () => {
      const width = app.shell.node.clientWidth;
      const smaller = width < NARROW && width < before, grown = width >= NARROW && before < NARROW;
      if ((smaller || grown) && this.opened && this.widget.isVisible) {
        requestAnimationFrame(() => this.widen(true)); // once JupyterLab has its new layout
        if (grown && this.leftCollapsed) { this.leftCollapsed = false; app.shell.expandLeft(); }
      }
      before = width;
    });
  }

  add(robot) {
    this.robots.set(robot.panel, robot);
    robot.panel.disposed.connect(() => { this.robots.delete(robot.panel); robot.content.dispose(); this.follow(); });
    this.widget.addWidget(robot.content);
    this.follow();
  }

  /** Show the active notebook's robot. A sidebar that a robot has opened closes for a notebook without one. */
  follow() {
    const { shell } = this.app;
    const current = this.robots.get(this.tracker.currentWidget);
    for (const robot of this.robots.values()) robot.content.setHidden(robot !== current);
    if (current?.isEmpty() && this.opened && this.widget.isVisible) shell.collapseRight?.();
    else if (current && !current.isEmpty() && this.opened && current.wanted && !this.widget.isVisible) this.open();
  }

  /** Open the sidebar with the robot, wide enough to see it; the focus stays where it is. */
  open() {
    const { shell } = this.app, focused = /** @type {HTMLElement} */ (document.activeElement);
    this.opened = true;
    if (!this.widget.isVisible) shell.activateById(ID);
    if (focused !== document.activeElement) focused?.focus?.();
    requestAnimationFrame(() => this.widen());
  }

  /** Give the robot its share of the window. always: also if it has about that already. */
  widen(always = false) {
    const { shell } = this.app, split = shell._hsplitPanel; // JupyterLab has no public name for it
    const narrow = shell.node.clientWidth < NARROW;
    if (narrow && shell.leftCollapsed === false) { // its width counts until the next layout
      shell.collapseLeft();
      this.leftCollapsed = true; // until the window is wide again
      requestAnimationFrame(() => this.widen(true));
      return;
    }
    const share = narrow ? NARROW_SHARE : SHARE;
    const sizes = split?.relativeSizes() ?? [];
    const right = sizes.at(-1);
    const now = this.widget.node.clientWidth / shell.node.clientWidth;
    if (!sizes.length || (!always && now > 0.85 * share && now < MOST_SHARE)) return;
    split.setRelativeSizes(sizes.map((size, i) => (i === sizes.length - 1 ? share : size * (1 - share) / (1 - right || 1))));
  }
}

/** The robot of one notebook. */
export class RobotPanel {
  constructor(lab, sidebar, panel) {
    this.lab = lab;
    this.sidebar = sidebar;
    this.panel = panel;
    this.shown = {}; // the kernel's MIME bundle
    this.notice = NONE;
    this.wanted = true;
    this.watchers = new Set();
    this.content = new lab.BoxPanel();
    this.content.addClass("ros2-course-robot");
    this.fill();
    sidebar.add(this);
  }

  /** A button for the notebook's toolbar. */
  button() {
    return new this.lab.ToolbarButton({
      label: "Robot", tooltip: "Show the robot next to the notebook, or close it", onClick: () => this.toggle(),
    });
  }

  isEmpty() {
    return !Object.keys(this.shown).length;
  }

  /** Whether this live view plays now. */
  plays(model) {
    return Boolean(model) && this.shown[WIDGET]?.model_id === model;
  }

  /** Show the kernel's MIME bundle; a new live view opens the sidebar, if its notebook is active. */
  show(bundle) {
    this.shown = bundle;
    this.notice = NONE;
    this.fill();
    this.watchers.forEach((update) => update());
    if (WIDGET in bundle) this.wanted = true;
    if (WIDGET in bundle && this.sidebar.tracker.currentWidget === this.panel) this.sidebar.open();
  }

  /** The kernel is gone, and its robot with it. */
  lose() {
    if (this.isEmpty()) return;
    this.shown = {};
    this.notice = RESTARTED;
    announce(RESTARTED); // a region that comes with its text is often not announced
    this.fill();
    this.watchers.forEach((update) => update());
  }

  toggle() {
    if (!this.sidebar.widget.isVisible) this.reveal();
    else {
      this.wanted = false;
      this.sidebar.app.shell.collapseRight();
    }
  }

  reveal() {
    this.wanted = true;
    this.sidebar.follow();
    this.sidebar.open();
  }

  async fill() {
    const bundle = this.shown;
    const { rendermime } = this.panel.content;
    const kind = rendermime.preferredMimeType(bundle, "any");
    let view;
    if (kind) {
      view = rendermime.createRenderer(kind);
      await view.renderModel(rendermime.createModel({ data: bundle, trusted: true }));
    } else {
      view = new this.lab.Widget();
      view.addClass("ros2-course-notice");
      view.node.setAttribute("role", "status");
      view.node.textContent = this.notice;
    }
    if (bundle !== this.shown || this.content.isDisposed) { view.dispose(); return; }
    for (const old of [...this.content.widgets]) old.dispose();
    this.content.addWidget(view);
  }
}

/** The output of the cell instead of the picture; robotOf returns the robot of the notebook of a node and a live view. */
export function robotRenderer(lab, robotOf) {
  const view = new lab.Widget();
  view.addClass("ros2-course-beside");
  const button = Object.assign(document.createElement("button"), { textContent: "Show the robot", className: "jp-Button" });
  button.addEventListener("click", () => robotOf(view.node, model)?.reveal());
  let model, robot;
  const update = () => {
    if (robot?.plays(model)) view.node.replaceChildren("The robot plays in the panel “Robot” on the right. ", button);
    else view.node.replaceChildren("A robot played here. Run the cell to let it play again.");
  };
  view.renderModel = async (mime) => { model = mime.data[ROBOT]?.model; update(); };
  const attach = () => {
    const found = robotOf(view.node, model);
    if (found && found !== robot) { robot = found; robot.watchers.add(update); }
    update();
  };
  const onAfterAttach = view.onAfterAttach.bind(view);
  view.onAfterAttach = (message) => { onAfterAttach(message); attach(); };
  view.disposed.connect(() => robot?.watchers.delete(update));
  return view;
}
