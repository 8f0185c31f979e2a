// The panel beside the notebook with its robot: the live view, and the replay after the run.

export const ROBOT = "application/vnd.ros2-course.robot+json";
const NARROW = 900; // px; in a narrower notebook the robot is below the code
const LOW = 600; // px; in a narrow and lower one, such as a page at 200 %, it has its own tab
let count = 0;

export class RobotPanel {
  constructor(lab, app, panel) {
    Object.assign(this, { lab, app, panel, shown: {} });
    panel.disposed.connect(() => this.widget?.dispose());
  }

  /** A button for the notebook's toolbar. */
  button() {
    return new this.lab.ToolbarButton({
      label: "Robot", tooltip: "Show the robot beside the notebook", onClick: () => this.reveal(),
    });
  }

  /** Show the kernel's MIME bundle; a new live view opens the panel. */
  show(bundle) {
    const plays = !("text/html" in bundle);
    this.shown = bundle;
    if (plays && Object.keys(bundle).length) this.isLow() ? this.reveal() : this.open();
    else if (this.widget) this.fill();
  }

  open() {
    if (this.widget?.isDisposed !== false) {
      this.content = new this.lab.BoxPanel();
      this.content.addClass("ros2-course-robot");
      this.widget = new this.lab.MainAreaWidget({ content: this.content });
      this.widget.id = `ros2-course-robot-${++count}`;
      this.widget.title.label = "Robot";
      this.widget.title.closable = true;
      this.widget.title.caption = `The robot of ${this.panel.title.label}`;
      // A closed panel is detached, not disposed: its view could not be created a second time.
      this.widget.onCloseRequest = () => { this.widget.parent = null; };
      this.filled = undefined;
    }
    if (!this.widget.isAttached) this.app.shell.add(this.widget, "main", { ...this.place(), activate: false });
    if (this.filled !== this.shown) this.fill();
  }

  /** Open the panel and bring it to the front. */
  reveal() {
    this.open();
    if (!this.widget.isVisible) this.app.shell.activateById(this.widget.id);
  }

  /** Whether there is no space for notebook and robot side by side or one above the other. */
  isLow() {
    const { clientWidth, clientHeight } = this.app.shell.node;
    return clientWidth < NARROW && clientHeight < LOW;
  }

  /** The panel's position: beside the notebook, or with the robots of other notebooks. */
  place() {
    const others = [...this.app.shell.widgets("main")].filter(({ id }) => id.startsWith("ros2-course-robot-"));
    if (others.length) return { mode: "tab-after", ref: others[0].id };
    if (this.isLow()) return { mode: "tab-after", ref: this.panel.id };
    return { mode: this.panel.node.clientWidth < NARROW ? "split-bottom" : "split-right", ref: this.panel.id };
  }

  async fill() {
    const bundle = this.filled = this.shown;
    const { rendermime } = this.panel.content;
    const kind = rendermime.preferredMimeType(bundle, "any");
    let view;
    if (kind) {
      view = rendermime.createRenderer(kind);
      await view.renderModel(rendermime.createModel({ data: bundle, trusted: true }));
    } else {
      view = new this.lab.Widget();
      view.node.textContent = "No robot plays yet. Run a cell with play(...), and it drives here.";
    }
    if (bundle !== this.shown || this.content.isDisposed) { view.dispose(); return; }
    for (const old of [...this.content.widgets]) old.dispose();
    this.content.addWidget(view);
  }
}

/** The output of the cell instead of the picture; panelOf returns the robot panel of the notebook of a node. */
export function robotRenderer(lab, panelOf) {
  const view = new lab.Widget();
  view.addClass("ros2-course-beside");
  const button = Object.assign(document.createElement("button"), { textContent: "Show the robot", className: "jp-Button" });
  button.addEventListener("click", () => panelOf(view.node)?.reveal());
  view.node.append("The robot plays in the panel “Robot”. ", button);
  view.renderModel = async () => {};
  return view;
}
