// The live view of a run: ../live.py sends frames and facts, this sends back commands. Several views of one run,
// and a page that is loaded again, each begin with what the kernel last said.

const REPEAT = 100; // ms between commands while something is held
const SILENCE = 3000; // ms without news, after which the view says so
const LONGEST_TRAIL = 4000; // points
const HOW = "Click the picture, then drive with the arrow keys or W A S D. Space stops the robot.";
const WAYS = { up: [1, 0], down: [-1, 0], left: [0, 1], right: [0, -1] };
const KEYS = {
  ArrowUp: "up", ArrowDown: "down", ArrowLeft: "left", ArrowRight: "right",
  KeyW: "up", KeyS: "down", KeyA: "left", KeyD: "right",
};

/** A pad and keys that drive: what is held is sent at once, then again and again, and zero when it is let go. */
class Pad {
  constructor(root, send) {
    this.send = send;
    this.held = new Set();
    this.root = make("div", { className: "pad", role: "group", "aria-label": "Drive" });
    const labels = { up: "Forwards", left: "Turn left", right: "Turn right", down: "Backwards" };
    this.buttons = Object.fromEntries(Object.entries(labels).map(([way, label]) => [way, this.button(way, label)]));
    const halt = button("stop", "Stand still", () => this.release());
    halt.classList.add("halt");
    this.root.append(...Object.values(this.buttons), halt);
    root.addEventListener("keydown", (event) => this.key(event));
    root.addEventListener("keyup", (event) => KEYS[event.code] && this.drop(KEYS[event.code], event));
    root.addEventListener("focusout", (event) => { if (!root.contains(event.relatedTarget)) this.release(); });
    this.leave = () => this.release();
    this.hidden = () => { if (document.hidden) this.release(); };
    window.addEventListener("blur", this.leave);
    document.addEventListener("visibilitychange", this.hidden);
  }

  close() {
    this.release();
    window.removeEventListener("blur", this.leave);
    document.removeEventListener("visibilitychange", this.hidden);
  }

  button(way, label) {
    const element = button(way, label);
    element.classList.add(way);
    element.addEventListener("pointerdown", (event) => { element.focus(); this.hold(way, event); });
    for (const end of ["pointerup", "pointercancel", "pointerleave", "lostpointercapture", "contextmenu"]) {
      element.addEventListener(end, (event) => this.drop(way, event));
    }
    element.addEventListener("keydown", (event) => { if (event.key === "Enter") this.hold(way, event); });
    element.addEventListener("keyup", (event) => { if (event.key === "Enter") this.drop(way, event); });
    return element;
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) { this.release(); return; }
    if (event.target.tagName === "SELECT" || event.target.closest(".graph")) return;
    if (KEYS[event.code]) this.hold(KEYS[event.code], event);
    else if (event.code === "Space" && event.target.tagName !== "BUTTON") {
      event.preventDefault();
      this.release(true);
    }
  }

  hold(way, event) {
    event.preventDefault();
    if (this.held.has(way)) return;
    this.held.add(way);
    this.tell();
    this.timer ??= setInterval(() => this.tell(), REPEAT);
  }

  drop(way, event) {
    event.preventDefault();
    if (!this.held.delete(way)) return;
    if (this.held.size) this.tell();
    else this.release(true);
  }

  /** Let go of everything; `always` sends a zero even if nothing was held. */
  release(always = false) {
    const driving = this.held.size > 0;
    this.held.clear();
    clearInterval(this.timer);
    this.timer = undefined;
    if (driving || always) this.tell();
  }

  tell() {
    const sum = (axis) => [...this.held].reduce((total, way) => total + WAYS[way][axis], 0);
    for (const [way, element] of Object.entries(this.buttons)) element.classList.toggle("held", this.held.has(way));
    this.send({ drive: [sum(0), sum(1)] });
  }
}

/** Clock, controls, topics, and with a world picture and pad. */
class View {
  constructor(model) {
    this.model = model;
    this.world = model.get("world") && checkWorld(model.get("world"));
    this.trails = [];
    this.stage = make("div", { className: "stage" });
    this.topics = make("div");
    this.rows = new Map(); // a topic's name to its row; rows stay, so that a click and the focus do
    this.numbers = make("dl", { className: "numbers" });
    this.topic = new Topic();
    this.graph = new Graph(() => this.askForGraph());
    this.head = make("div", { className: "head" });
    const rows = [this.numbers, make("div", {}, this.head, this.topics), this.topic.root];
    this.root = make("div", { className: "ros2-view live" }, make("style", {}, STYLE));
    this.root.dataset.lmSuppressShortcuts = "true"; // keys are for the robot, not for the notebook
    this.turtles = this.world?.bodies[0].kind === "turtle"; // any number of them: a frame is as long as they need
    this.drives = this.turtles || this.world?.bodies.some((body) => body.kind === "robot"); // else there is a machine
    if (this.drives) {
      this.pad = new Pad(this.root, (command) => this.send(command));
      // Above the topics: driving adds one, and the pad must not move away from under the pointer.
      rows.unshift(make("div", {}, make("div", { className: "head" }, "DRIVE"), this.pad.root));
    }
    const how = this.drives ? HOW : "Watch the run; the buttons pause it, go on step by step, and end it.";
    const row = make("div", { className: "row" }, ...(this.world ? [this.stage] : []),
      make("div", { className: "side" }, ...rows));
    this.root.append(make("div", { className: "how" }, how), this.controls(), row, this.graph.root);
    this.tick = setInterval(() => { this.showSilence(); this.askForGraph(); }, SILENCE / 3);
    this.onFrame = (_, [buffer]) => this.frame(buffer);
    this.onStatus = () => this.showStatus();
    this.onGraph = () => this.showGraph();
    model.on("msg:custom", this.onFrame);
    model.on("change:status", this.onStatus);
    model.on("change:graph", this.onGraph);
    this.news = performance.now();
  }

  start() {
    if (this.world) {
      this.scene = new Scene(this.stage, this.world);
      this.scene.canvas.addEventListener("pointerdown", () => this.scene.canvas.focus());
      if (this.drives) {
        // To a screen reader it is a thing that takes keys itself.
        this.scene.canvas.setAttribute("role", "application");
        this.scene.canvas.setAttribute("aria-label", `The robot in the world ${this.world.name}. ${HOW}`);
      }
    }
    this.showGraph();
    this.showStatus();
  }

  close() {
    clearInterval(this.tick);
    this.model.off("msg:custom", this.onFrame);
    this.model.off("change:status", this.onStatus);
    this.model.off("change:graph", this.onGraph);
    this.pad?.close();
    this.scene?.close();
  }

  send(command) {
    if (!this.status.ended) this.model.send(command);
  }

  controls() {
    this.toggle = button("pause", "Pause", () => this.send({ pause: !this.status.paused }));
    this.step = button("on", "One step of 0.05 s", () => this.send({ step: true }));
    this.halt = button("stop", "End the run", () => this.send({ stop: true }));
    this.select = speeds([0.25, 0.5, 1, 2, 4, 10], (speed) => this.send({ speed }));
    this.clock = make("b", {}, "0.00");
    this.pace = make("span");
    this.said = make("div", { className: "say", role: "status" });
    return make("div", { className: "bar" },
      make("div", { className: "group" }, this.toggle, this.step, this.halt), this.select,
      make("div", { className: "time" }, this.clock, " s"), this.pace, this.said);
  }

  get status() {
    return this.model.get("status") || {};
  }

  /** Take a frame; see ../live.py for what is in it. */
  frame(buffer) {
    this.news = performance.now();
    const floats = new Float32Array(buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.byteLength));
    this.clock.textContent = floats[0].toFixed(2);
    if (!this.scene) return;
    const { bodies, lidar } = this.world;
    const pose = (at) => [floats[at], floats[at + 1], floats[at + 2]];
    const count = this.turtles ? (floats.length - 1) / 3 : bodies.length;
    const poses = Array.from({ length: count }, (_, index) => pose(1 + 3 * index));
    const behind = 1 + 3 * count;
    const scan = floats.length > behind
      ? { pose: pose(behind), ranges: floats.subarray(behind + 3), ...lidar } : null;
    poses.forEach((_, index) => {
      const body = this.scene.bodyOf(index);
      this.scene.include(body, poses[index]);
      if (body.kind === "robot") this.extend(this.trails[index] ||= [], poses[index]);
    });
    this.scene.frame = { ...this.scene.frame, poses, scan, trails: this.trails };
    this.scene.ask();
  }

  extend(trail, [x, y]) {
    const last = trail.at(-1);
    if (last && Math.hypot(x - last[0], y - last[1]) < 0.005) return;
    trail.push([x, y]);
    if (trail.length > LONGEST_TRAIL) trail.splice(0, LONGEST_TRAIL / 4);
  }

  showStatus() {
    this.news = performance.now();
    const { stamp = 0, speed, pace = 0, paused = false, topics = [], contacts = [], ended = null } = this.status;
    this.toggle.show(paused ? "play" : "pause", paused ? "Go on" : "Pause");
    this.toggle.disabled = this.halt.disabled = this.select.disabled = Boolean(ended);
    this.step.disabled = !paused || Boolean(ended);
    if (speed !== undefined) this.select.put(speed ?? Infinity); // null stands for it: JSON has no infinity
    if (!this.scene || paused || ended) this.clock.textContent = stamp.toFixed(2);
    this.pace.textContent = ended ? "ended" : paused ? "paused" : `runs at ${pace.toFixed(pace < 10 ? 1 : 0)} ×`;
    this.said.textContent = ended ? ended[1] : "";
    for (const { name, type, rate } of topics) this.showTopic(name, type, rate);
    const { numbers: told, topic = null } = this.status; // a robot that is a program of its own tells neither
    this.head.textContent = told ? "TOPICS: CLICK ONE TO LOOK INTO IT" : "TOPICS";
    this.numbers.replaceChildren(...(told ?? []).flatMap(([label, value]) => [make("dt", {}, label), make("dd", {}, value)]));
    this.topic.show(topic);
    for (const [name, row] of this.rows) {
      row.disabled = !told;
      row.setAttribute("aria-expanded", String(name === topic?.name));
    }
    if (!this.scene) return;
    const drawn = this.status.drawn && checkDrawn(this.status.drawn);
    this.scene.frame = { ...this.scene.frame, contacts, drawn };
    this.scene.ask();
  }

  showTopic(name, type, rate) {
    let row = this.rows.get(name);
    if (!row) {
      row = make("button", { type: "button", className: "topic", title: type }, make("span", {}, name),
        make("span", { className: "rate" }));
      row.addEventListener("click", () => {
        this.send({ topic: row.getAttribute("aria-expanded") === "true" ? "" : name });
      });
      this.rows.set(name, row);
      this.topics.append(row);
    }
    row.lastChild.textContent = rate ? `${Number(rate.toPrecision(3))} Hz` : "-";
    this.graph.tell(name, row.lastChild.textContent);
  }

  /** Once a second, while somebody looks: the kernel draws none for nobody, and tells of changes only. */
  askForGraph() {
    if (this.graph.seen) this.send({ graph: true });
  }

  showGraph() {
    const graph = this.model.get("graph");
    this.graph.root.hidden = !graph;
    if (graph?.boxes) this.graph.show(graph);
  }

  showSilence() {
    const { paused, ended } = this.status;
    const silent = !paused && !ended && performance.now() - this.news > SILENCE;
    if (silent) this.said.textContent = "No news: the kernel is busy with another cell, or has stopped.";
    else if (!ended) this.said.textContent = "";
  }
}

export default {
  render({ model, el }) {
    const view = new View(model);
    el.append(view.root);
    view.start();
    return () => view.close();
  },
};
