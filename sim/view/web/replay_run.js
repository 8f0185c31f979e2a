// Parses the data of a replay (../replay_data.py). It is untrusted: invalid data throws a TypeError.

const STRIP = 240; // columns of a topic's timeline
const KINDS = ["contact", "error", "missed", "push", "end", "goal", "DEBUG", "INFO", "WARN", "ERROR", "FATAL"];
const UNITS = { pose: [1e-3, 1e-3, 1e-3, 1e-6, 1e-6, 1e-6], frames: Array(6).fill(1e-3) }; // of stored whole numbers
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
  const sampled = (values) => list(values, 1000, (value) => (value === null ? NaN : number(value, 1e12)));
  const plotted = list(curves, 2, ([name, from]) => (
    Array.isArray(from) ? { name: text(name), values: sampled(from), line: 0 } : { name: text(name), values: null, line: size(from) }
  ));
  if (plotted.some(({ values }) => values && values.length !== moments.length)) refuse("a value for each stamp");
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
    key: KEY.test(run.run ?? "") ? run.run : "", plays: run.plays === true, path: world !== null && run.path === true, failure: text(run.failure ?? ""), title: text(run.title ?? ""), tip: tipPath(world, tracks.at(-1) ?? []), open: run.open === undefined ? end : Math.min(size(run.open), end),
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
    layers: list(run.layers ?? [], 500, checkLayer), seen: list(run.seen ?? [], 500, checkLayer), beliefs: list(run.beliefs ?? [], 50, checkBelief),
    strip: run.strip ? checkStrip(run.strip) : null,
    topics: topics.map((topic, index) => ({ ...topic, messages: messages[index] ?? null })),
  };
}

/**
 * What follows the end of a replay: a run in which nothing more happens is cut.
 * @param {{marks: {kind: string, stamp: number}[], end: number}} run
 */
function restText({ marks, end }) {
  const over = marks.find(({ kind }) => kind === "end")?.stamp ?? end;
  return over > end + 0.005 ? `, at rest until ${over.toFixed(0)} s` : "";
}

/** The data of `Topic.show` for a topic of a replay at a time (s): the stored message before it, and its curves. */
function topicAt({ name, messages: { type, stamps, texts, curves, count } }, time, images = []) {
  const at = before(stamps, time);
  const value = (lines, line) => Number((lines[line] ?? "").split(": ")[1] ?? NaN);
  const points = ({ line, values }) => stamps.map((stamp, index) => [stamp, values?.[index] ?? value(texts[index], line)])
    .filter(([, y]) => Number.isFinite(y));
  const stored = count > stamps.length ? `\n# ${stamps.length} of ${count} messages are stored here` : "";
  return {
    name, type, cursor: time, image: layersAt(images, time).find(({ topic, kind }) => topic === name && kind === "image")?.data, stamp: at < 0 ? null : stamps[at],
    text: at < 0 ? "No message yet." : texts[at].join("\n") + stored,
    curves: curves.map((curve) => ({ name: curve.name, along: "s", points: points(curve) })),
  };
}

/** Parses a pose or a frame: its layers in the order of time. */
function checkBelief({ topic, kind, name, stamps, columns }) {
  if (!Object.hasOwn(UNITS, kind)) refuse("a pose or a frame");
  const moments = cumulated(stamps, 1), values = list(columns, 6, (column) => cumulated(column, 1));
  if (values.length !== 6 || values.some((column) => column.length !== moments.length)) refuse("a value for each stamp");
  return moments.map((stamp, index) => checkLayer({
    stamp, topic, kind, name, data: values.map((column, axis) => column[index] * UNITS[kind][axis]),
  }));
}

/** All layers of a run at a time (s). @param {Run} run @returns {Layer[]} */
function allLayersAt({ layers, seen, beliefs }, time) {
  return [...layersAt(layers, time), ...layersAt(seen, time), ...beliefsAt(beliefs, time)];
}

/** Of layers in the order of time, each topic's newest at a time (s). @param {Layer[]} layers @returns {Layer[]} */
function layersAt(layers, time) {
  return [...new Map(layers.slice(0, before(layers, time, stampOf) + 1).map((layer) => [layer.topic, layer])).values()];
}

/** The poses and frames at a time (s), between those that were published. @param {Layer[][]} beliefs @returns {Layer[]} */
function beliefsAt(beliefs, time) {
  return beliefs.filter((track) => track.length && track[0].stamp <= time + 1e-6).map((track) => {
    const at = before(track, time, stampOf), now = track[at], next = track[at + 1];
    if (!next) return now;
    const share = (time - now.stamp) / (next.stamp - now.stamp || 1);
    // A quaternion and its negative are one rotation.
    const sign = now.kind === "frames" && now.data.slice(2).reduce((sum, value, index) => sum + value * next.data[index + 2], 0) < 0 ? -1 : 1;
    const data = now.data.map((value, index) => value + share * ((index > 1 ? sign : 1) * next.data[index] - value));
    if (now.kind === "pose") data[2] = between(now.data, next.data, share)[2];
    return { ...now, data };
  });
}

/** Interpolates two poses; the yaw along the shorter direction. */
function between(a, b, share) {
  const part = Math.min(Math.max(share, 0), 1);
  const turn = Math.atan2(Math.sin(b[2] - a[2]), Math.cos(b[2] - a[2]));
  return [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + turn * part];
}
