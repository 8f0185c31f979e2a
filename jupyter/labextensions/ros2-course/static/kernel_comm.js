// The comm from a notebook's page to its kernel; sim/notebook/page_comm.py is the other end. The page sends the ids and
// sources of the cells before it executes one; the kernel sends the content of the robot panel.

const TARGET = "ros2-course";
const GONE = ["restarting", "autorestarting", "terminating", "dead"]; // states in which a kernel has lost its robot

export class KernelComm {
  constructor(panel, robotPanel) {
    this.panel = panel;
    this.robotPanel = robotPanel;
    this.session = panel.sessionContext;
    this.attach = this.attach.bind(this);
    this.session.kernelChanged.connect(this.attach);
    this.session.ready.then(this.attach);
    this.onStatus = (_, status) => { if (GONE.includes(status)) this.robotPanel.lose(); };
    this.session.statusChanged.connect(this.onStatus);
  }

  close() {
    this.session.kernelChanged.disconnect(this.attach);
    this.session.statusChanged.disconnect(this.onStatus);
    this.comm = undefined;
  }

  /** Accept a comm from the kernel, or connect to one that was opened before this page was loaded. */
  async attach() {
    const kernel = this.session.session?.kernel;
    if (!kernel || kernel === this.kernel) return;
    if (this.kernel) this.robotPanel.lose();
    this.kernel = kernel;
    kernel.registerCommTarget(TARGET, (comm) => this.open(comm));
    const { content } = await kernel.requestCommInfo({ target_name: TARGET });
    const [id] = Object.keys(content.comms ?? {});
    if (id && !kernel.hasComm(id)) this.open(kernel.createComm(TARGET, id));
  }

  open(comm) {
    comm.commsOverSubshells = "disabled"; // keeps messages in order with executed cells
    this.comm = comm;
    this.sent = new Map();
    comm.onMsg = ({ content }) => this.robotPanel.show(content.data.show);
    comm.onClose = () => { if (this.comm === comm) this.comm = undefined; };
    comm.send({ hello: true });
    this.sendCells();
  }

  /** Send the order of the cells and the changed sources to the kernel. */
  sendCells() {
    if (!this.comm || this.comm.isDisposed) return;
    const texts = {}, order = [];
    for (const cell of this.panel.content.model?.cells ?? []) {
      if (cell.type !== "code") continue;
      const text = cell.sharedModel.getSource();
      order.push(cell.id);
      if (this.sent.get(cell.id) !== text) texts[cell.id] = text;
      this.sent.set(cell.id, text);
    }
    this.comm.send({ order, texts });
  }
}
