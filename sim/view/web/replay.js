// Turns every inert div with a packed recording (../packing.py) into a player. The data may come from anybody: it is
// checked piece by piece, words are only ever shown as text, and on any fault the div keeps its PNG.

const MOST_CHARACTERS = 4e6, MOST_BYTES = 16e6; // of packed and unpacked data
const STRIP = 240; // columns of a topic's timeline
const STAYS = 0.06; // s after its last pose, for which a body is still shown
const LINES = 6; // log lines that show at once
const KINDS = ["contact", "error", "end", "DEBUG", "INFO", "WARN", "ERROR", "FATAL"];

async function unpack(packed) {
  if (packed.length > MOST_CHARACTERS) refuse("less data");
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const decoder = new TextDecoder();
  let json = "";
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    json += decoder.decode(piece.value, { stream: true });
    if (json.length > MOST_BYTES) { await reader.cancel(); refuse("less data"); }
  }
  return JSON.parse(json);
}

/** Whole numbers that were written as differences, the first one from 0; `unit` is what one of them means. */
function undo(differences, unit) {
  let sum = 0;
  return list(differences, 1e5, (step) => number(sum += number(step, 1e9), 1e9) * unit);
}

function checkRun(run) {
  if (run.version !== 1) refuse("version 1");
  const world = run.world === null ? null : checkWorld(run.world);
  const stamps = undo(run.stamps, 1e-3);
  const ordered = (all) => all.every((stamp, i) => stamp >= (i ? all[i - 1] : 0)) ? all : refuse("rising stamps");
  const track = (columns) => {
    const [x, y, yaw] = columns.map((column) => undo(column, 1e-3));
    if ([x, y, yaw].some((column) => column.length !== stamps.length)) refuse("a pose for each stamp");
    return stamps.map((_, i) => [x[i], y[i], yaw[i]]);
  };
  const tracks = list(run.tracks, 500, track);
  if (tracks.length !== (world ? world.bodies.length : 0)) refuse("a track for each body");
  const times = (pair) => numbers(2)(pair.map((stamp) => number(stamp, 1e9) * 1e-3));
  const there = run.there && list(run.there, 500, (stays) => list(stays, 10000, times));
  if (there && there.length !== tracks.length) refuse("when each body was there");
  const event = ([stamp, kind, said, place]) => ({
    stamp: number(stamp, 1e9) * 1e-3, kind: KINDS.includes(kind) ? kind : refuse("a kind of event"), words: text(said),
    place: place === null ? null : numbers(2)(place),
  });
  return {
    graph: run.graph ? checkGraph(run.graph) : null, // those of older pages have none
    world, stamps: ordered(stamps), tracks, there, drawing: run.drawing && checkDrawing(run.drawing), end: size(run.end) || 0.001, speed: size(run.speed),
    scans: list(run.scans, 20000, (scan) => ({
      stamp: number(scan.stamp, 1e9) * 1e-3, pose: numbers(3)(scan.pose), start: number(scan.start),
      step: number(scan.step), far: number(scan.far),
      // -1 met nothing within reach, -2 measured nothing
      ranges: undo(scan.ranges, 1).map((range) => (range >= 0 ? range * 0.02 : range === -1 ? Infinity : NaN)),
    })),
    marks: list(run.marks, 1000, event),
    logs: list(run.logs, 1000, event),
    topics: list(run.topics, 100, ([name, told, strip]) => ({
      name: text(name), told: text(told), strip: text(strip, STRIP),
    })),
  };
}

class Player {
  constructor(run) {
    this.run = run;
    this.speed = run.speed;
    this.time = run.end; // as the run left it
    this.playing = false;
    this.root = make("div", { className: "ros2-view" });
    this.root.dataset.lmSuppressShortcuts = "true";
    this.stage = make("div", { className: "stage" });
    this.side = make("div", { className: "side" });
    const row = make("div", { className: "row" }, ...(run.world ? [this.stage] : []), this.side);
    this.graph = new Graph();
    this.root.append(make("style", {}, STYLE), row, this.controls(), this.graph.root);
    this.strips = this.timeline();
    this.lines = make("div", { className: "logs" });
    if (run.logs.length) this.side.append(make("div", {}, make("div", { className: "head" }, "LOG"), this.lines));
    if (!this.side.childElementCount) this.side.remove();
  }

  /** Begin to draw; only now has the root a place and a size. */
  start() {
    const { world, tracks } = this.run;
    if (world) {
      this.scene = new Scene(this.stage, world);
      tracks.forEach((track, index) => track.forEach((pose) => this.scene.include(world.bodies[index], pose)));
    }
    if (this.run.graph) this.graph.show(this.run.graph);
    this.paintStrips();
    onTheme(this.root, () => this.paintStrips());
    this.show();
  }

  controls() {
    const { run } = this;
    this.toggle = button("play", "Play", () => this.play(!this.playing));
    this.clock = make("b");
    const range = { type: "range", min: 0, max: run.end, step: "any", value: run.end };
    this.slider = make("input", { ...range, "aria-label": "Simulated time in seconds" });
    this.slider.addEventListener("input", () => this.seek(Number(this.slider.value)));
    const marks = make("div", { className: "marks" }, ...run.marks.map((mark) => this.mark(mark)));
    this.said = make("div", { className: "say", role: "status" });
    const select = speeds([0.25, 0.5, 1, 2, 4, 10], (speed) => { this.speed = speed; });
    select.put(run.speed);
    return make("div", { className: "bar" },
      make("div", { className: "group" }, button("back", "One frame back", () => this.step(-1)), this.toggle,
        button("on", "One frame on", () => this.step(1))),
      make("div", { className: "time" }, this.clock, make("span", {}, ` / ${run.end.toFixed(2)} s`)),
      make("div", { className: "scrub" }, this.slider, marks), select, this.said);
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
    const rows = this.run.topics.map(({ name, told, strip }) => {
      const canvas = make("canvas", { width: STRIP, height: 1 }), cursor = make("i");
      const row = make("div", { className: "topic", title: name }, make("span", {}, name),
        make("span", { className: "rate" }, told), make("div", { className: "strip" }, canvas, cursor));
      return { row, canvas, cursor, strip };
    });
    this.side.append(make("div", {}, make("div", { className: "head" }, "TOPICS"), ...rows.map(({ row }) => row)));
    return rows;
  }

  paintStrips() {
    for (const { canvas, strip } of this.strips) {
      const context = canvas.getContext("2d");
      context.clearRect(0, 0, STRIP, 1);
      context.fillStyle = colours(this.root).robots[0];
      [...strip].forEach((sign, column) => { if (sign === "1") context.fillRect(column, 0, 1, 1); });
    }
  }

  play(playing) {
    cancelAnimationFrame(this.frame); // whoever plays again in the same frame would be twice as fast
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
      if (this.time >= this.run.end) this.play(false);
      else this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }

  seek(time) {
    this.play(false);
    this.time = Math.min(Math.max(time, 0), this.run.end);
    this.show();
  }

  /** To the next or the last pose, or by 0.05 s where nothing moves. */
  step(way) {
    const { stamps } = this.run;
    const at = before(stamps, this.time);
    const next = way < 0 && stamps[at] < this.time - 1e-6 ? at : at + way;
    this.seek(stamps.length ? stamps[Math.min(Math.max(next, 0), stamps.length - 1)] : this.time + 0.05 * way);
  }

  show() {
    const { run, time } = this;
    this.clock.textContent = time.toFixed(2);
    this.slider.value = time;
    this.slider.setAttribute("aria-valuetext", `${time.toFixed(2)} seconds`);
    const mark = run.marks[before(run.marks, time, stampOf)];
    const words = mark ? mark.words : "";
    if (this.said.textContent !== words) this.said.textContent = words;
    for (const { cursor } of this.strips) cursor.style.left = `${100 * time / run.end}%`;
    this.showLogs(before(run.logs, time, stampOf));
    if (this.scene) this.showScene();
  }

  showLogs(last) {
    if (last === this.lastLog) return;
    this.lastLog = last;
    const lines = this.run.logs.slice(Math.max(last + 1 - LINES, 0), last + 1);
    this.lines.replaceChildren(...lines.map(({ stamp, kind, words }) =>
      make("div", { className: kind }, `${stamp.toFixed(2)} ${words}`)));
  }

  showScene() {
    const { run, time } = this;
    const at = before(run.stamps, time), next = Math.min(at + 1, run.stamps.length - 1);
    const away = (index) => run.there && !run.there[index].some(([from, to]) => from <= time + 1e-6 && time <= to + STAYS);
    const poses = run.tracks.map((track, index) => away(index) ? null : at < 0 ? track[0] : between(track[at], track[next],
      (time - run.stamps[at]) / (run.stamps[next] - run.stamps[at] || 1)));
    const scan = run.scans[before(run.scans, time, stampOf)];
    this.scene.frame = {
      poses, scan: scan || null,
      trails: run.tracks.map((track, body) => (run.there ? null : [...track.slice(0, at + 1), poses[body]])), ahead: run.tracks,
      drawn: run.drawing && shownAt(run.drawing, time),
      contacts: run.marks.filter(({ stamp, place }) => place && stamp <= time + 1e-6).map(({ place }) => place),
    };
    this.scene.ask();
  }
}

/** The pose between two others; a yaw takes the shorter way round. */
function between(a, b, share) {
  const part = Math.min(Math.max(share, 0), 1);
  const turn = Math.atan2(Math.sin(b[2] - a[2]), Math.cos(b[2] - a[2]));
  return [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + turn * part];
}

async function wire(div) {
  div.dataset.wired = "true";
  const picture = [...div.childNodes];
  try {
    const player = new Player(checkRun(await unpack(div.dataset.replay || "")));
    div.replaceChildren(player.root);
    player.start();
  } catch (fault) {
    div.replaceChildren(...picture);
    console.warn(`This replay stays a picture: ${fault.message}`);
  }
}

document.querySelectorAll("div.ros2-replay:not([data-wired])").forEach(wire);
