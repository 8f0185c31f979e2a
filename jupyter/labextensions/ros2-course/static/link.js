// The line from a notebook's page to its kernel; sim/notebook/page.py has the other end. The page tells which cells there
// are and what stands in them, before each one that runs; the kernel tells what the panel beside is to show.

const TARGET = "ros2-course";

export class Link {
  constructor(panel, dock) {
    this.panel = panel;
    this.dock = dock;
    this.session = panel.sessionContext;
    this.attach = this.attach.bind(this);
    this.session.kernelChanged.connect(this.attach);
    this.session.ready.then(this.attach);
  }

  close() {
    this.session.kernelChanged.disconnect(this.attach);
    this.comm = undefined;
  }

  /** Be ready for a kernel that calls, and call one that has called already, before this page was loaded. */
  async attach() {
    const kernel = this.session.session?.kernel;
    if (!kernel || kernel === this.kernel) return;
    this.kernel = kernel;
    kernel.registerCommTarget(TARGET, (comm) => this.open(comm));
    const { content } = await kernel.requestCommInfo({ target_name: TARGET });
    const [id] = Object.keys(content.comms ?? {});
    if (id && !kernel.hasComm(id)) this.open(kernel.createComm(TARGET, id));
  }

  open(comm) {
    comm.commsOverSubshells = "disabled"; // what is told stays in order with the cells that run
    this.comm = comm;
    this.told = new Map();
    comm.onMsg = ({ content }) => this.dock.show(content.data.show);
    comm.onClose = () => { if (this.comm === comm) this.comm = undefined; };
    comm.send({ hello: true });
    this.tell();
  }

  /** Tell the kernel what stands in the cells. */
  tell() {
    if (!this.comm || this.comm.isDisposed) return;
    const texts = {}, order = [];
    for (const cell of this.panel.content.model?.cells ?? []) {
      if (cell.type !== "code") continue;
      const text = cell.sharedModel.getSource();
      order.push(cell.id);
      if (this.told.get(cell.id) !== text) texts[cell.id] = text;
      this.told.set(cell.id, text);
    }
    this.comm.send({ order, texts });
  }
}
