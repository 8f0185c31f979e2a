// Turns every inert div with a recording (../replay_data.py) into a player. The data is untrusted: it is validated, text
// is only inserted as text nodes, and on any error the div keeps its PNG.

const PERSISTENCE = 0.06; // s for which a body is shown after its last pose
const LINES = 6; // visible log lines

class Player {
  /** @param {Run} run */
  constructor(run) {
    this.run = run;
    this.speed = run.speed;
    this.time = run.open;
    this.playing = false;
    this.topic = new Topic((time) => this.seek(time));
    /** @type {RunTopic | null} */
    this.selected = null; // the topic that is looked into
    this.root = make("div", { className: "ros2-view" });
    this.root.dataset.lmSuppressShortcuts = "true";
    this.stage = make("div", { className: "stage" });
    this.side = make("div", { className: "side" });
    this.choice = new LayerChoice(() => { this.paintStrips(); this.show(); });
    this.signs = make("span");
    this.legend = make("div", { className: "legend" }, this.signs, this.choice.root);
    const controls = this.controls(), main = make("div", { className: "ros2-column" }, this.stage, this.legend, controls);
    const rows = run.world ? [make("div", { className: "row" }, main, this.side)] : [this.side, controls];
    this.graph = new Graph();
    this.numbers = make("dl", { className: "numbers", hidden: !run.strip?.labels.length });
    this.values = (run.strip?.labels ?? []).map(() => make("dd"));
    this.values.forEach((value, index) => this.numbers.append(make("div", {}, make("dt", {}, run.strip.labels[index]), value)));
    this.failure = make("div", { className: "failure" }, run.failure);
    this.root.append(make("style", {}, STYLE), ...rows, this.numbers, this.graph.root);
    if (run.failure) this.root.append(this.failure);
    this.strips = this.timeline();
    this.lines = make("div", { className: "logs" });
    if (run.logs.length) this.side.append(make("div", {}, make("div", { className: "head" }, "LOG"), this.lines));
    if (this.side.childElementCount) return;
    this.side.remove();
    this.root.classList.toggle("ros2-narrow", Boolean(run.world) && !run.strip);
  }

  /** Start drawing, after the root has been added to the page and has a size. */
  start() {
    if (this.run.world) this.picture = runCanvas(this.stage, this.run);
    if (this.run.graph) this.graph.show(this.run.graph);
    this.paintStrips();
    onTheme(this.root, () => this.paintStrips());
    this.show();
    followCursor(this.root, this.run.key, (time, show) => {
      this.goTo(time);
      if (show) this.root.scrollIntoView({ block: "nearest" });
    });
    followTimeLinks();
    if (this.run.plays && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.playInSight();
  }

  /** Start to play from the beginning when the picture comes into sight. */
  playInSight() {
    const sight = new IntersectionObserver(([entry]) => {
      if (!entry.isIntersecting) return;
      sight.disconnect();
      if (!this.playing) this.play(true);
    });
    sight.observe(this.root);
  }

  controls() {
    const { run } = this;
    this.toggle = button("play", "Play", () => this.play(!this.playing));
    this.clock = make("b");
    const range = { type: "range", min: 0, max: run.end, step: "any", value: run.end };
    this.slider = make("input", { ...range, "aria-label": "Simulated time in seconds" });
    this.slider.addEventListener("input", () => this.seek(Number(this.slider.value)));
    const marks = make("div", { className: "marks" }, ...run.marks.map((mark) => this.mark(mark)));
    this.statusLine = make("div", { className: "say", role: "status" });
    const select = speeds([0.25, 0.5, 1, 2, 4, 10], (speed) => { this.speed = speed; });
    select.put(run.speed);
    return make("div", { className: "bar" },
      make("div", { className: "group" }, button("back", "One frame back", () => this.step(-1)), this.toggle,
        button("on", "One frame forward", () => this.step(1))),
      make("div", { className: "time" }, this.clock, make("span", {}, ` / ${run.end.toFixed(2)} s${restText(run)}`)),
      make("div", { className: "scrub" }, this.slider, marks), select, this.statusLine);
  }

  mark(mark) {
    const element = make("button", { type: "button", className: mark.kind, title: mark.words });
    element.setAttribute("aria-label", mark.words);
    element.style.left = `${100 * Math.min(mark.stamp / this.run.end, 1)}%`;
    element.addEventListener("click", () => this.seek(mark.stamp));
    return element;
  }

  timeline() {
    if (!this.run.topics.length) return [];
    const rows = this.run.topics.map((topic) => {
      const { name, traffic, strip } = topic;
      const canvas = make("canvas", { width: STRIP, height: 1 }), cursor = make("i");
      const parts = [make("span", {}, name), make("span", { className: "rate" }, traffic), make("div", { className: "strip" }, canvas, cursor)];
      const row = topic.messages
        ? make("button", { type: "button", className: "topic", title: topic.messages.type, "aria-expanded": "false" }, ...parts)
        : make("div", { className: "topic", title: name }, ...parts);
      if (topic.messages) row.addEventListener("click", () => this.select(topic, row));
      return { row, canvas, cursor, strip, name };
    });
    this.side.append(make("div", {}, make("div", { className: "head" }, this.run.topics.some(({ messages }) => messages) ? "TOPICS: CLICK ONE TO LOOK INTO IT" : "TOPICS"), ...rows.map(({ row }) => row)));
    return rows;
  }

  /** Show the messages of this topic next to its row, or hide them again. */
  select(topic, row) {
    this.selected = this.selected === topic ? null : topic;
    for (const strip of this.strips) strip.row.setAttribute("aria-expanded", String(Boolean(this.selected) && strip.row === row));
    if (this.selected) row.after(this.topic.root);
    this.showTopic();
  }

  showTopic() {
    this.topic.show(this.selected && { ...topicAt(this.selected, this.time, this.run.seen), end: this.run.end });
  }

  paintStrips() {
    const look = colors(this.root), { world, layers, seen, beliefs } = this.run;
    this.failure.style.color = look.failure;
    if (world) {
      this.signs.replaceChildren(make("b", {}, world.name), ...legendElements(legendOf(world, look)));
      this.choice.offer([...layers, ...beliefs.flat(), ...seen], look);
    }
    for (const { canvas, strip } of this.strips) {
      const context = canvas.getContext("2d");
      context.clearRect(0, 0, STRIP, 1);
      context.fillStyle = colors(this.root).robots[0];
      [...strip].forEach((sign, column) => { if (sign === "1") context.fillRect(column, 0, 1, 1); });
    }
  }

  play(playing) {
    cancelAnimationFrame(this.frame); // a second loop would double the speed
    this.playing = playing;
    this.toggle.show(playing ? "pause" : "play", playing ? "Pause" : "Play");
    if (!playing) return;
    if (this.time >= this.run.end) this.time = 0;
    let last = performance.now();
    const tick = (now) => {
      if (!this.playing || !this.root.isConnected) { this.play(false); return; }
      this.time = Math.min(this.time + Math.max(now - last, 0) / 1000 * this.speed, this.run.end);
      last = now;
      this.show();
      this.announce();
      if (this.time >= this.run.end) this.play(false);
      else this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }

  goTo(time) {
    this.play(false);
    this.time = Math.min(Math.max(time, 0), this.run.end);
    this.show();
  }

  seek(time) {
    this.goTo(time);
    this.announce();
  }

  /** Seek to the next or previous pose, or by 0.05 s if nothing moves. */
  step(direction) {
    const { stamps } = this.run;
    const at = before(stamps, this.time);
    const next = direction < 0 && stamps[at] < this.time - 1e-6 ? at : at + direction;
    this.seek(stamps.length ? stamps[Math.min(Math.max(next, 0), stamps.length - 1)] : this.time + 0.05 * direction);
  }

  show() {
    const { run, time } = this;
    this.clock.textContent = time.toFixed(2);
    this.slider.value = time;
    this.slider.setAttribute("aria-valuetext", `${time.toFixed(2)} seconds`);
    const mark = run.marks[before(run.marks, time, stampOf)];
    const words = mark ? mark.words : "";
    if (this.statusLine.textContent !== words) this.statusLine.textContent = words;
    this.statusLine.classList.toggle("success", mark?.kind === "goal");
    const column = Math.min(Math.floor(time / run.end * STRIP), STRIP - 1);
    for (const { cursor, strip, name } of this.strips) {
      cursor.style.left = `${100 * time / run.end}%`;
      this.graph.setActive(name, strip[column] === "1");
    }
    this.showLogs(before(run.logs, time, stampOf));
    this.showNumbers();
    if (this.selected) this.showTopic();
    if (this.picture) this.showWorld();
  }

  /** Let all pictures of the run show this moment. */
  announce() {
    moveCursor(this.run.key, this.time, this.root);
  }

  /** The values at the cursor; before the first ones, the first. */
  showNumbers() {
    const { strip } = this.run;
    if (!strip?.labels.length) return;
    const at = Math.max(before(strip.stamps, this.time), 0);
    this.values.forEach((value, index) => { value.textContent = strip.columns[index][at] || "-"; });
  }

  showLogs(last) {
    if (last === this.lastLog) return;
    this.lastLog = last;
    const lines = this.run.logs.slice(Math.max(last + 1 - LINES, 0), last + 1);
    this.lines.replaceChildren(...lines.map(({ stamp, kind, words }) => {
      const at = make("button", { type: "button", className: "at", title: "Move the replay here" }, stamp.toFixed(2));
      at.addEventListener("click", () => this.seek(stamp));
      return make("div", { className: kind }, at, ` ${words}`);
    }));
  }

  showWorld() {
    this.picture.frame = frameAt(this.run, this.time, this.choice);
    this.picture.requestPaint();
  }
}

/** What a WorldCanvas shows of a run at a time (s). @param {Run} run @param {number} time @param {LayerChoice} choice @returns {Frame} */
function frameAt(run, time, choice) {
  const at = before(run.stamps, time), next = Math.min(at + 1, run.stamps.length - 1);
  const isAbsent = (index) => run.presence && !run.presence[index].some(([from, to]) => from <= time + 1e-6 && time <= to + PERSISTENCE);
  const poses = run.tracks.map((track, index) => isAbsent(index) ? null : at < 0 ? track[0] : between(track[at], track[next],
    (time - run.stamps[at]) / (run.stamps[next] - run.stamps[at] || 1)));
  return {
    poses, scan: run.scans[before(run.scans, time, stampOf)] || null,
    trails: run.tracks.map((track, body) => (run.presence ? null : [...track.slice(0, at + 1), poses[body]])), ahead: run.tracks,
    tip: run.tip && [...run.tip.slice(0, at + 1), ...tipPath(run.world, poses.slice(-1))], tipAhead: run.tip,
    layers: allLayersAt(run, time).filter((layer) => choice.shows(layer)),
    drawn: run.drawing && visibleAt(run.drawing, time), reached: run.reached !== null && run.reached <= time + 1e-6,
    contacts: run.marks.filter(({ stamp, place }) => place && stamp <= time + 1e-6).map(({ place }) => place),
  };
}

/** Adds the canvas of a run to a stage, with room for all poses. */
function runCanvas(stage, { world, tracks }) {
  const picture = new WorldCanvas(stage, world);
  tracks.forEach((track, index) => track.forEach((pose) => picture.include(world.bodies[index], pose)));
  return picture;
}

/** The whole path of a run in its world, and the bodies at the cursor: first at the end. */
class PathPicture {
  /** @param {Run} run */
  constructor(run) {
    this.run = run;
    this.stage = make("div", { className: "stage" });
    this.choice = new LayerChoice(() => this.show());
    this.signs = make("span");
    this.legend = make("div", { className: "legend" }, this.signs, this.choice.root);
    this.root = make("div", { className: "ros2-view ros2-path" }, make("style", {}, STYLE), this.stage, this.legend);
    this.failure = make("div", { className: "failure" }, run.failure);
    if (run.failure) this.root.append(this.failure);
    this.root.dataset.lmSuppressShortcuts = "true";
  }

  start() {
    this.picture = runCanvas(this.stage, this.run);
    this.picture.canvas.setAttribute("aria-label", this.run.title ? `A map of ${this.run.title}` : `The path in the world ${this.run.world.name}`);
    onTheme(this.root, () => this.show());
    this.show(this.run.end);
    followCursor(this.root, this.run.key, (time) => this.show(Math.min(time, this.run.end)));
    followTimeLinks();
  }

  show(time = this.time) {
    const { run, choice } = this, whole = frameAt(run, run.end, choice);
    this.time = time;
    const paths = run.presence ? [] : run.tracks; // turtles leave lines of their pens
    const starts = run.tracks.map((track, index) => (run.world.bodies[index].kind === "robot" && track.length > 1 ? track[0] : null));
    this.picture.frame = { ...frameAt(run, time, choice), trails: paths, ahead: [], tip: run.tip, tipAhead: null, contacts: whole.contacts, starts };
    this.picture.requestPaint();
    this.showLegend(whole.contacts.length);
  }

  showLegend(contacts) {
    const { world, tip, title, stamps } = this.run, look = colors(this.root), moves = stamps.length > 1;
    const robots = world.bodies.filter(({ kind }) => kind === "robot");
    const entries = [
      ...(moves ? robots : []).map(({ name }, index) => ["—", look.robots[index % look.robots.length], index ? name : "path"]),
      ...(moves && robots.length ? [["●", look.ghost, "start"]] : []), ...(tip ? [["—", look.robots[0], "tip's path"]] : []),
      ...(world.goal ? [["★", look.goal, "goal"]] : []), ...(contacts ? [["✕", look.contact, "contact"]] : []),
    ];
    this.failure.style.color = look.failure;
    const head = [...(title ? [make("b", {}, title)] : []), ...(moves ? [make("span", { className: "time" }, `t = ${this.time.toFixed(2)} s`)] : [])];
    this.signs.replaceChildren(...head, ...legendElements(entries));
    this.choice.offer(this.run.layers, look);
  }
}

async function install(div) {
  div.dataset.wired = "true";
  const picture = [...div.childNodes];
  try {
    const run = checkRun(await unpack(div.dataset.replay || ""));
    const player = run.path ? new PathPicture(run) : new Player(run);
    div.replaceChildren(player.root);
    player.start();
  } catch (error) {
    div.replaceChildren(...picture);
    console.warn(`This replay stays a picture: ${error.message}`);
  }
}

/** Wire all replays of the page; outputs without this script call it. */
window.ros2CourseReplays = () => document.querySelectorAll("div.ros2-replay:not([data-wired])").forEach(install);
window.ros2CourseReplays();
