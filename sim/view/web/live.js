// The live view of a run: ../live_view.py sends frames and status, this sends commands. Several views of one run,
// and a reloaded page, start with the kernel's latest status.

const REPEAT = 100; // ms between commands while a key or button is held
const TIMEOUT = 1500; // ms without messages after which the view shows a notice
const FOLDED = ["/tf", "/tf_static", "/clock", "/joint_states", "/robot_description", "/parameter_events", "/rosout"];
const RARE = 0.5; // Hz; of rarer messages the number is shown
const MAX_TRAIL = 4000; // points
const MOVE_HOW = "Click the picture, then use the arrow keys or W A S D.";
const POINT_HOW = "Click into the picture, or drag.";
const POINT_GAP = 40; // ms, at least, between points of a drag
const HOW = "Click the picture, then drive with the arrow keys or W A S D. Space stops the robot.";
const BEST = "ros2-course-best-times"; // in the browser: world -> s
const DIRECTIONS = { up: [1, 0], down: [-1, 0], left: [0, 1], right: [0, -1] };
const LAYERS = ["layers", "quiet", "shown"]; // of the model
const SIGHT = 100; // px, the least side of a picture to drive by
const KEYS = {
  ArrowUp: "up", ArrowDown: "down", ArrowLeft: "left", ArrowRight: "right",
  KeyW: "up", KeyS: "down", KeyA: "left", KeyD: "right",
};

/** A sentence on a time (s) to the star that is the best in this browser and world; "" for the first one. */
function comparedToBest(world, seconds) {
  try {
    const times = JSON.parse(localStorage.getItem(BEST) ?? "{}"), before = times[world];
    if (!(before <= seconds)) localStorage.setItem(BEST, JSON.stringify({ ...times, [world]: seconds }));
    return before > seconds ? ` Your best time here; before: ${before.toFixed(1)} s.` : "";
  } catch {
    return ""; // a page that may not store anything
  }
}

/** Drive pad and keys: a held direction is sent at once and repeatedly; its release sends zero. */
class Pad {
  constructor(root, send) {
    this.send = send;
    this.held = new Set();
    this.root = make("div", { className: "pad", role: "group", "aria-label": "Drive" });
    const labels = { up: "Forwards", left: "Turn left", right: "Turn right", down: "Backwards" };
    this.buttons = Object.fromEntries(Object.entries(labels).map(([direction, label]) => [direction, this.button(direction, label)]));
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

  button(direction, label) {
    const element = button(direction, label);
    element.classList.add(direction);
    element.addEventListener("pointerdown", (event) => { element.focus(); this.hold(direction, event); });
    for (const end of ["pointerup", "pointercancel", "pointerleave", "lostpointercapture", "contextmenu"]) {
      element.addEventListener(end, (event) => this.drop(direction, event));
    }
    element.addEventListener("keydown", (event) => { if (event.key === "Enter") this.hold(direction, event); });
    element.addEventListener("keyup", (event) => { if (event.key === "Enter") this.drop(direction, event); });
    return element;
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) { this.release(); return; }
    if (event.target.tagName === "SELECT" || event.target.closest(".graph")) return;
    if (KEYS[event.code] && !event.shiftKey) this.hold(KEYS[event.code], event);
    else if (event.code === "Space" && event.target.tagName !== "BUTTON") {
      event.preventDefault();
      this.release(true);
    }
  }

  hold(direction, event) {
    event.preventDefault();
    if (this.held.has(direction)) return;
    this.held.add(direction);
    this.sendDrive();
    this.timer ??= setInterval(() => this.sendDrive(), REPEAT);
  }

  drop(direction, event) {
    event.preventDefault();
    if (!this.held.delete(direction)) return;
    if (this.held.size) this.sendDrive();
    else this.release(true);
  }

  /** Release all keys and buttons; `always` sends zero even if none was held. */
  release(always = false) {
    const driving = this.held.size > 0;
    this.held.clear();
    clearInterval(this.timer);
    this.timer = undefined;
    if (driving || always) this.sendDrive();
  }

  sendDrive() {
    const sum = (axis) => [...this.held].reduce((total, direction) => total + DIRECTIONS[direction][axis], 0);
    for (const [direction, element] of Object.entries(this.buttons)) element.classList.toggle("held", this.held.has(direction));
    this.send({ drive: [sum(0), sum(1)] });
  }
}

/** Clock, controls and topics; with a world, its picture and the pad. */
class View {
  constructor(model) {
    this.model = model;
    this.world = model.get("world") && checkWorld(model.get("world"));
    this.trails = [];
    this.tip = null; // the path of an arm's far end
    this.reached = null; // when the goal was reached first (s)
    this.success = ""; // the sentence about it
    this.stage = make("div", { className: "stage" });
    this.topics = make("div");
    this.rows = new Map(); // topic name -> its row; rows are kept, to preserve clicks and focus
    this.numbers = make("dl", { className: "numbers" });
    this.more = make("details", { className: "more", hidden: true }, make("summary", {}, "More topics"));
    this.topic = new Topic();
    this.graph = new Graph(() => this.requestGraph());
    this.head = make("div", { className: "head" });
    this.root = make("div", { className: "ros2-view live" }, make("style", {}, STYLE));
    this.root.dataset.lmSuppressShortcuts = "true"; // keys drive the robot instead of the notebook
    this.turtles = this.world?.bodies[0].kind === "turtle"; // their number changes: a frame's length follows from it
    this.drives = this.turtles || this.world?.bodies.some((body) => body.kind === "robot"); // otherwise it is a machine
    const inputs = model.get("inputs") ?? []; // what nodes read: "keys", "points"
    this.points = inputs.includes("points");
    if ((this.drives && !this.points) || inputs.includes("keys")) { // the pad would cover what is to be clicked
      this.pad = new Pad(this.root, (command) => this.send(command));
      if (this.drives) this.stage.append(this.pad.root); // in the picture: a robot that is out of sight can't be driven
      else this.pad.root.classList.add("below"); // a machine's picture may be low, and the pad would cover it
    }
    this.howTo = this.points ? POINT_HOW : this.drives ? HOW : this.pad ? MOVE_HOW : "";
    this.how = make("div", { className: "how" }, this.howTo || "Watch the run; the buttons pause it, advance it step by step, and end it.");
    this.statusLine = make("div", { className: "say", role: "status" });
    this.warningLine = make("div", { className: "warning", role: "status", hidden: true });
    this.choice = new LayerChoice(() => this.choose());
    this.signs = make("span");
    this.legend = make("div", { className: "legend" }, this.signs, this.choice.root);
    this.clicked = ""; // the topic that was clicked, until it shows
    /** @type {Layer[]} */
    this.fixed = []; // maps, plans and goals
    /** @type {Layer[]} */
    this.moving = []; // the layers of the newest frame
    const padBelow = this.pad && !this.drives ? [this.pad.root] : [];
    const picture = this.world ? [this.stage, ...padBelow, this.legend] : [];
    this.root.append(this.how, this.controls(), ...picture, this.warningLine, this.statusLine, this.numbers,
      make("div", { className: "topics" }, this.head, this.topics, this.more), this.graph.root);
    this.tick = setInterval(() => { this.showTimeout(); this.requestGraph(); }, TIMEOUT / 3);
    this.onFrame = ({ layers }, [buffer]) => this.frame(buffer, layers);
    this.onStatus = () => this.showStatus();
    this.onGraph = () => this.showGraph();
    this.onLayers = () => this.showLayers();
    model.on("msg:custom", this.onFrame);
    model.on("change:status", this.onStatus);
    model.on("change:graph", this.onGraph);
    for (const name of LAYERS) model.on(`change:${name}`, this.onLayers);
    this.lastMessage = performance.now();
  }

  start() {
    if (this.world) {
      this.picture = new WorldCanvas(this.stage, this.world);
      this.showLegend();
      onTheme(this.root, () => this.showLegend());
      this.picture.canvas.addEventListener("pointerdown", () => this.picture.canvas.focus());
      if (this.points) this.watchPointer();
      if (this.pad || this.points) {
        // Screen readers must pass keys on to it.
        this.picture.canvas.setAttribute("role", "application");
        this.picture.canvas.setAttribute("aria-label", `The robot in the world ${this.world.name}. ${this.howTo}`);
      }
    }
    this.showGraph();
    this.showLayers();
    this.showStatus();
  }

  /** Send where the picture is clicked or dragged; while it is zoomed in, a drag moves the view instead. */
  watchPointer() {
    const { canvas, camera } = this.picture;
    canvas.style.touchAction = "none";
    let last = 0;
    const point = (event) => {
      if (event.buttons !== 1 || camera.zoom > 1 || event.timeStamp - last < POINT_GAP) return;
      last = event.timeStamp;
      const { scale, x, y } = camera.view();
      this.send({ point: [x + (event.offsetX - this.picture.width / 2) / scale, y + (this.picture.height / 2 - event.offsetY) / scale] });
    };
    canvas.addEventListener("pointerdown", (event) => { last = 0; point(event); });
    canvas.addEventListener("pointermove", point);
  }

  showLegend() {
    const look = colors(this.root);
    this.signs.replaceChildren(make("b", {}, this.world.name), ...legendElements(legendOf(this.world, look)));
    const quiet = list(this.model.get("quiet") ?? [], 20, ([topic, kind]) => ({ topic: text(topic), kind: QUIET.includes(kind) ? kind : refuse("a kind of layer") }));
    this.choice.offer([...this.fixed, ...quiet], look);
  }

  /** The reader has chosen layers: the kernel sends those that move, for all views of the run. */
  choose() {
    const shown = (this.model.get("quiet") ?? []).filter(([topic, kind]) => this.choice.shows({ topic, kind }));
    this.model.set("shown", shown.map(([topic]) => topic));
    this.model.save_changes();
    this.showLayers();
  }

  showLayers() {
    if (!this.picture) return;
    this.fixed = list(this.model.get("layers") ?? [], 20, checkLayer);
    const shown = this.model.get("shown") ?? [];
    for (const [topic] of this.model.get("quiet") ?? []) this.choice.chosen.set(topic, shown.includes(topic));
    this.putLayers();
    this.showLegend();
    this.picture.requestPaint();
  }

  close() {
    clearInterval(this.tick);
    this.model.off("msg:custom", this.onFrame);
    this.model.off("change:status", this.onStatus);
    this.model.off("change:graph", this.onGraph);
    for (const name of LAYERS) this.model.off(`change:${name}`, this.onLayers);
    this.pad?.close();
    this.picture?.close();
  }

  send(command) {
    if ("drive" in command && !this.isInSight()) return;
    // Once it has driven, the hint has done its work; while a button is held, nothing may move from under the pointer.
    if (command.drive?.every((part) => part === 0)) this.how.hidden = true;
    if (!this.status.ended) this.model.send(command);
  }

  controls() {
    this.toggle = button("pause", "Pause", () => this.send({ pause: !this.status.paused }));
    this.step = button("on", "One step of 0.05 s", () => this.send({ step: true }));
    this.halt = button("stop", "End the run", () => this.send({ stop: true }));
    this.select = speeds([0.25, 0.5, 1, 2, 4, 10], (speed) => this.send({ speed }));
    this.clock = make("b", {}, "0.00");
    this.pace = make("span");
    return make("div", { className: "bar" },
      make("div", { className: "group" }, this.toggle, this.step, this.halt), this.select,
      make("div", { className: "time" }, this.clock, " s"), this.pace);
  }

  get status() {
    return this.model.get("status") || {};
  }

  /** Whether the robot's picture is large enough to drive by. */
  isInSight() {
    const least = this.drives ? SIGHT : SIGHT / 2; // a track is low
    return Boolean(this.picture) && this.picture.width >= SIGHT && this.picture.height >= least;
  }

  /** Show a frame; ../live_view.py defines its format. */
  frame(buffer, layers = []) {
    this.lastMessage = performance.now();
    const floats = new Float32Array(buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.byteLength));
    this.clock.textContent = floats[0].toFixed(2);
    if (!this.picture) return;
    const { bodies, lidar } = this.world;
    /** @returns {[number, number, number]} */
    const pose = (at) => [floats[at], floats[at + 1], floats[at + 2]];
    const count = this.turtles ? (floats.length - 1) / 3 : bodies.length;
    const poses = Array.from({ length: count }, (_, index) => pose(1 + 3 * index));
    const end = 1 + 3 * count;
    const scan = floats.length > end
      ? { pose: pose(end), ranges: floats.subarray(end + 3), ...lidar } : null;
    poses.forEach((_, index) => {
      const body = this.picture.bodyOf(index);
      this.picture.include(body, poses[index]);
      if (body.kind === "robot") this.extend(this.trails[index] ||= [], poses[index]);
    });
    const tip = tipPath(this.world, poses.slice(-1));
    if (tip) this.extend(this.tip ??= [], tip[0]);
    if (this.reached === null && isAtGoal(this.world, poses)) {
      this.reached = floats[0];
      this.success = reachedText(this.reached) + comparedToBest(this.world.name, this.reached);
      this.showEvent(this.status.ended);
    }
    this.picture.frame = { ...this.picture.frame, poses, scan, trails: this.trails, tip: this.tip, reached: this.reached !== null };
    // An image is decoded once.
    this.moving = list(layers, 100, checkLayer).map((layer) => this.moving.find(({ topic, kind, stamp }) => topic === layer.topic && kind === "image" && stamp === layer.stamp) ?? layer);
    this.putLayers();
    this.picture.requestPaint();
  }

  putLayers() {
    this.picture.frame.layers = [...this.fixed, ...this.moving].filter((layer) => this.choice.shows(layer));
  }

  /** Append a point to a path. @param {number[][]} trail @param {number[]} point */
  extend(trail, [x, y]) {
    const last = trail.at(-1);
    if (last && Math.hypot(x - last[0], y - last[1]) < 0.005) return;
    trail.push([x, y]);
    if (trail.length > MAX_TRAIL) trail.splice(0, MAX_TRAIL / 4);
  }

  showStatus() {
    this.lastMessage = performance.now();
    const { stamp = 0, speed, pace = 0, paused = false, topics = [], contacts = [], ended = null } = this.status;
    this.toggle.show(paused ? "play" : "pause", paused ? "Go on" : "Pause");
    this.toggle.disabled = this.halt.disabled = this.select.disabled = Boolean(ended);
    this.step.disabled = !paused || Boolean(ended);
    if (speed !== undefined) this.select.put(speed ?? Infinity); // null means infinity, which JSON doesn't have
    if (!this.picture || paused || ended) this.clock.textContent = stamp.toFixed(2);
    this.pace.textContent = ended ? "ended" : paused ? "paused" : `runs at ${pace.toFixed(pace < 10 ? 1 : 0)} ×`;
    this.showEvent(ended);
    for (const topic of topics) this.showTopic(topic);
    const { numbers: counts, topic = null, touching = false } = this.status;
    this.head.textContent = counts ? "TOPICS: CLICK ONE TO LOOK INTO IT" : "TOPICS";
    this.numbers.replaceChildren(...(counts ?? []).map(([label, value]) => make("div", { className: label === "contacts" && touching ? "event" : "" },
      make("dt", {}, label), make("dd", {}, value))));
    const selected = topic && this.rows.get(topic.name);
    if (selected && selected.nextSibling !== this.topic.root) selected.after(this.topic.root);
    this.topic.show(topic);
    if (selected && this.clicked === topic.name) this.bringUp(selected);
    for (const [name, row] of this.rows) {
      row.disabled = !counts;
      row.setAttribute("aria-expanded", String(name === topic?.name));
    }
    if (!this.picture) return;
    const drawn = this.status.drawn && checkDrawn(this.status.drawn);
    this.picture.frame = { ...this.picture.frame, contacts, drawn };
    this.picture.requestPaint();
  }

  /** That the goal was reached, and the end of the run or a contact, while it lasts: all are announced to screen readers. */
  showEvent(ended) {
    const { warning = "", touching = false } = this.status; // a stand-alone robot has warnings, and a click where no box fits
    this.warningLine.hidden = !warning;
    if (this.warningLine.textContent !== warning) this.warningLine.textContent = warning;
    const [, contact] = this.status.numbers?.find(([label]) => label === "contacts") ?? [];
    const event = ended ? ended[1] : touching && contact ? `Contacts: ${contact}.` : "";
    const text = [this.success, event].filter(Boolean).join(" ");
    if (text !== this.event) this.statusLine.textContent = this.event = text;
    this.statusLine.classList.toggle("success", Boolean(this.success));
  }

  /** Scroll a topic that was clicked to below the picture, which stays in sight. */
  bringUp(row) {
    this.clicked = "";
    row.style.scrollMarginTop = `${this.stage.offsetHeight}px`;
    row.scrollIntoView({ block: "start" });
  }

  showTopic({ name, type, rate, count = 0 }) {
    let row = this.rows.get(name);
    if (!row) {
      row = make("button", { type: "button", className: "topic", title: type }, make("span", {}, name),
        make("span", { className: "rate" }));
      row.addEventListener("click", () => {
        this.clicked = row.getAttribute("aria-expanded") === "true" ? "" : name;
        this.send({ topic: this.clicked });
      });
      this.rows.set(name, row);
      if (FOLDED.includes(name)) { this.more.append(row); this.more.hidden = false; } else this.topics.append(row);
    }
    const rare = count ? `${count} message${count > 1 ? "s" : ""}` : "-";
    row.lastChild.textContent = rate >= RARE ? `${Number(rate.toPrecision(3))} Hz` : rare;
    this.graph.setRate(name, row.lastChild.textContent);
  }

  /** Called once a second: the kernel lays out the graph on request only, and sends changes only. */
  requestGraph() {
    if (this.graph.visible) this.send({ graph: true });
  }

  showGraph() {
    const graph = this.model.get("graph");
    this.graph.root.hidden = !graph;
    if (graph?.boxes) this.graph.show(graph);
  }

  showTimeout() {
    const { paused, ended } = this.status;
    const timedOut = !paused && !ended && performance.now() - this.lastMessage > TIMEOUT;
    this.root.classList.toggle("waits", timedOut);
    if (timedOut) {
      this.pace.textContent = "waits";
      this.statusLine.textContent = "The robot waits: the kernel is busy with another cell, or has stopped.";
      this.event = undefined; // shown again afterwards
    }
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
