// Turns every inert div with a recording (../replay_data.py) into a player. The data is untrusted: it is validated, text
// is only inserted as text nodes, and on any error the div keeps its PNG.

const MAX_CHARACTERS = 4e6, MAX_BYTES = 16e6; // of compressed and decompressed data
const STRIP = 240; // columns of a topic's timeline
const PERSISTENCE = 0.06; // s for which a body is shown after its last pose
const LINES = 6; // visible log lines
const KINDS = ["contact", "error", "end", "DEBUG", "INFO", "WARN", "ERROR", "FATAL"];

async function unpack(packed) {
  if (packed.length > MAX_CHARACTERS) refuse("less data");
  const bytes = Uint8Array.from(atob(packed), (character) => character.charCodeAt(0));
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const decoder = new TextDecoder();
  let json = "";
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    json += decoder.decode(piece.value, { stream: true });
    if (json.length > MAX_BYTES) { await reader.cancel(); refuse("less data"); }
  }
  return JSON.parse(json);
}

/** Decodes whole numbers stored as differences, the first one from 0; `unit` is the value of 1. */
function cumulated(differences, unit) {
  let sum = 0;
  return list(differences, 1e5, (step) => number(sum += number(step, 1e9), 1e9) * unit);
}

function checkRun(run) {
  if (run.version !== 1) refuse("version 1");
  const world = run.world === null ? null : checkWorld(run.world);
  const stamps = cumulated(run.stamps, 1e-3);
  const ordered = (all) => all.every((stamp, i) => stamp >= (i ? all[i - 1] : 0)) ? all : refuse("rising stamps");
  const track = (columns) => {
    const [x, y, yaw] = columns.map((column) => cumulated(column, 1e-3));
    if ([x, y, yaw].some((column) => column.length !== stamps.length)) refuse("a pose for each stamp");
    return stamps.map((_, i) => [x[i], y[i], yaw[i]]);
  };
  const tracks = list(run.tracks, 500, track);
  if (tracks.length !== (world ? world.bodies.length : 0)) refuse("a track for each body");
  const times = (pair) => numbers(2)(pair.map((stamp) => number(stamp, 1e9) * 1e-3));
  const presence = run.there && list(run.there, 500, (intervals) => list(intervals, 10000, times));
  if (presence && presence.length !== tracks.length) refuse("when each body was there");
  const event = ([stamp, kind, words, place]) => ({
    stamp: number(stamp, 1e9) * 1e-3, kind: KINDS.includes(kind) ? kind : refuse("a kind of event"), words: text(words),
    place: place === null ? null : numbers(2)(place),
  });
  return {
    graph: run.graph ? checkGraph(run.graph) : null, // older pages have none
    world, stamps: ordered(stamps), tracks, presence, drawing: run.drawing && checkDrawing(run.drawing), end: size(run.end) || 0.001, speed: size(run.speed),
    scans: list(run.scans, 20000, (scan) => ({
      stamp: number(scan.stamp, 1e9) * 1e-3, pose: numbers(3)(scan.pose), start: number(scan.start),
      step: number(scan.step), far: number(scan.far),
      // -1: out of range, -2: no measurement
      ranges: cumulated(scan.ranges, 1).map((range) => (range >= 0 ? range * 0.02 : range === -1 ? Infinity : NaN)),
    })),
    marks: list(run.marks, 1000, event),
    logs: list(run.logs, 1000, event),
    topics: list(run.topics, 100, ([name, traffic, strip]) => ({
      name: text(name), traffic: text(traffic), strip: text(strip, STRIP),
    })),
  };
}

class Player {
  constructor(run) {
    this.run = run;
    this.speed = run.speed;
    this.time = run.end;
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

  /** Start drawing, after the root has been added to the page and has a size. */
  start() {
    const { world, tracks } = this.run;
    if (world) {
      this.picture = new WorldCanvas(this.stage, world);
      tracks.forEach((track, index) => track.forEach((pose) => this.picture.include(world.bodies[index], pose)));
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
    this.statusLine = make("div", { className: "say", role: "status" });
    const select = speeds([0.25, 0.5, 1, 2, 4, 10], (speed) => { this.speed = speed; });
    select.put(run.speed);
    return make("div", { className: "bar" },
      make("div", { className: "group" }, button("back", "One frame back", () => this.step(-1)), this.toggle,
        button("on", "One frame on", () => this.step(1))),
      make("div", { className: "time" }, this.clock, make("span", {}, ` / ${run.end.toFixed(2)} s`)),
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
    const rows = this.run.topics.map(({ name, traffic, strip }) => {
      const canvas = make("canvas", { width: STRIP, height: 1 }), cursor = make("i");
      const row = make("div", { className: "topic", title: name }, make("span", {}, name),
        make("span", { className: "rate" }, traffic), make("div", { className: "strip" }, canvas, cursor));
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
    for (const { cursor } of this.strips) cursor.style.left = `${100 * time / run.end}%`;
    this.showLogs(before(run.logs, time, stampOf));
    if (this.picture) this.showWorld();
  }

  showLogs(last) {
    if (last === this.lastLog) return;
    this.lastLog = last;
    const lines = this.run.logs.slice(Math.max(last + 1 - LINES, 0), last + 1);
    this.lines.replaceChildren(...lines.map(({ stamp, kind, words }) =>
      make("div", { className: kind }, `${stamp.toFixed(2)} ${words}`)));
  }

  showWorld() {
    const { run, time } = this;
    const at = before(run.stamps, time), next = Math.min(at + 1, run.stamps.length - 1);
    const isAbsent = (index) => run.presence && !run.presence[index].some(([from, to]) => from <= time + 1e-6 && time <= to + PERSISTENCE);
    const poses = run.tracks.map((track, index) => isAbsent(index) ? null : at < 0 ? track[0] : between(track[at], track[next],
      (time - run.stamps[at]) / (run.stamps[next] - run.stamps[at] || 1)));
    const scan = run.scans[before(run.scans, time, stampOf)];
    this.picture.frame = {
      poses, scan: scan || null,
      trails: run.tracks.map((track, body) => (run.presence ? null : [...track.slice(0, at + 1), poses[body]])), ahead: run.tracks,
      drawn: run.drawing && visibleAt(run.drawing, time),
      contacts: run.marks.filter(({ stamp, place }) => place && stamp <= time + 1e-6).map(({ place }) => place),
    };
    this.picture.requestPaint();
  }
}

/** Interpolates two poses; the yaw along the shorter direction. */
function between(a, b, share) {
  const part = Math.min(Math.max(share, 0), 1);
  const turn = Math.atan2(Math.sin(b[2] - a[2]), Math.cos(b[2] - a[2]));
  return [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + turn * part];
}

async function install(div) {
  div.dataset.wired = "true";
  const picture = [...div.childNodes];
  try {
    const player = new Player(checkRun(await unpack(div.dataset.replay || "")));
    div.replaceChildren(player.root);
    player.start();
  } catch (error) {
    div.replaceChildren(...picture);
    console.warn(`This replay stays a picture: ${error.message}`);
  }
}

document.querySelectorAll("div.ros2-replay:not([data-wired])").forEach(install);
