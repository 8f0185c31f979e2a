// Parses the data of a replay (../replay_data.py). It is untrusted: invalid data throws a TypeError.

const STRIP = 240; // columns of a topic's timeline
const KINDS = ["contact", "error", "missed", "push", "end", "goal", "DEBUG", "INFO", "WARN", "ERROR", "FATAL"];
const KEY = /^[0-9a-f]{12}$/;

/** @typedef {ReturnType<typeof checkRun>} Run */
/** @typedef {Run["topics"][number]} RunTopic */

/** Decodes whole numbers stored as differences, the first one from 0; `unit` is the value of 1. */
function cumulated(differences, unit) {
  let sum = 0;
  return list(differences, 1e5, (step) => number(sum += number(step, 1e9), 1e9) * unit);
}

/** Decodes values of which 0 stands for the one before. */
function unchanged(values, most, parse) {
  let last = "";
  return list(values, most, (value) => (value === 0 ? last : last = parse(value)));
}

/** Parses the strip of values: for each label the text at each of the stamps. */
function checkStrip({ labels, stamps, values }) {
  const moments = cumulated(stamps, 1e-3);
  const columns = list(values, 40, (column) => unchanged(column, 1000, (value) => text(value, 100)));
  if (columns.length !== labels.length || columns.some((column) => column.length !== moments.length)) refuse("a value for each stamp");
  return { stamps: moments, labels: list(labels, 40, (label) => text(label)), columns };
}

/** Parses the stored messages of a topic: each a list of lines. */
function checkMessages({ type, count, stamps, texts, curves }) {
  let lines = [];
  const read = list(texts, 1000, (changes) => {
    lines = list(changes, 100, (line) => line).map((line, index) => (line === 0 ? text(lines[index]) : text(line)));
    return lines;
  });
  const moments = list(stamps, 1000, (stamp) => number(stamp, 1e9) * 1e-3);
  if (moments.length !== read.length) refuse("a text for each stamp");
  const plotted = list(curves, 2, ([name, line]) => ({ name: text(name), line: size(line) }));
  return { type: text(type), count: size(count), stamps: moments, texts: read, curves: plotted };
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
  const topics = list(run.topics, 100, ([name, traffic, strip]) => ({
    name: text(name), traffic: text(traffic), strip: text(strip, STRIP),
  }));
  const messages = list(run.messages ?? [], 100, checkMessages); // older pages have none
  const end = size(run.end) || 0.001;
  const moment = world ? stamps.findIndex((_, index) => isAtGoal(world, tracks.map((poses) => poses[index]))) : -1;
  const reached = moment < 0 ? null : stamps[moment];
  const success = reached ? [{ stamp: reached, kind: "goal", words: reachedText(reached), place: null }] : [];
  return {
    key: KEY.test(run.run ?? "") ? run.run : "", plays: run.plays === true, path: world !== null && run.path === true, failure: text(run.failure ?? ""), tip: tipPath(world, tracks.at(-1) ?? []), open: run.open === undefined ? end : Math.min(size(run.open), end),
    graph: run.graph ? checkGraph(run.graph) : null, // older pages have none
    world, stamps: ordered(stamps), tracks, presence, drawing: run.drawing && checkDrawing(run.drawing), end, speed: size(run.speed),
    scans: list(run.scans, 20000, (scan) => ({
      stamp: number(scan.stamp, 1e9) * 1e-3, pose: numbers(3)(scan.pose), start: number(scan.start),
      step: number(scan.step), far: number(scan.far),
      // -1: out of range, -2: no measurement
      ranges: cumulated(scan.ranges, 1).map((range) => (range >= 0 ? range * 0.02 : range === -1 ? Infinity : NaN)),
    })),
    reached,
    marks: [...list(run.marks, 1000, event), ...success].sort((one, other) => one.stamp - other.stamp),
    logs: list(run.logs, 1000, event),
    layers: list(run.layers ?? [], 500, checkLayer),
    strip: run.strip ? checkStrip(run.strip) : null,
    topics: topics.map((topic, index) => ({ ...topic, messages: messages[index] ?? null })),
  };
}

/** The data of `Topic.show` for a topic of a replay at a time (s): the stored message before it, and its curves. */
function topicAt({ name, messages: { type, stamps, texts, curves, count } }, time) {
  const at = before(stamps, time);
  const value = (lines, line) => Number((lines[line] ?? "").split(": ")[1] ?? NaN);
  const points = (line) => stamps.map((stamp, index) => [stamp, value(texts[index], line)]).filter(([, y]) => Number.isFinite(y));
  const stored = count > stamps.length ? `\n# ${stamps.length} of ${count} messages are stored here` : "";
  return {
    name, type, cursor: time, stamp: at < 0 ? null : stamps[at],
    text: at < 0 ? "No message yet." : texts[at].join("\n") + stored,
    curves: curves.map(({ name, line }) => ({ name, along: "s", points: points(line) })),
  };
}
