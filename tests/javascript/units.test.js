// What the scripts of the pages compute without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";
import { save } from "../../jupyter/labextensions/ros2-course/static/saving.js";
import { nextNotebook, tabName } from "../../jupyter/labextensions/ros2-course/static/tabs.js";
import { shown } from "../../jupyter/labextensions/ros2-course/static/widget_states.js";
import { load } from "./load.js";

const { checkWorld, list, number, numbers, text, checkGraph } = load(["checks"], ["checkWorld", "list", "number", "numbers", "text", "checkGraph"]);
const { before, rounded } = load(["elements"], ["before", "rounded"]);
const { viewAt } = load(["camera"], ["viewAt"]);
const { cumulated, unchanged, topicAt, checkRun, restText } = load(
  ["checks", "elements", "drawing", "layers", "world_canvas", "replay_run"], ["cumulated", "unchanged", "topicAt", "checkRun", "restText"],
);
const { checkLayer, layersAt, checkBelief, beliefsAt, LayerChoice } = load(
  ["checks", "elements", "layers", "replay_run"], ["checkLayer", "layersAt", "checkBelief", "beliefsAt", "LayerChoice"],
);
const { axesOf, ellipseOf } = load(["layer_paint"], ["axesOf", "ellipseOf"]);
const { isAtGoal } = load(["checks", "world_canvas"], ["isAtGoal"]);
const { tipPath } = load(["checks", "world_canvas"], ["tipPath"]);
const { visibleAt } = load(["checks", "elements", "drawing"], ["visibleAt"]);
const { legendOf } = load(["legend"], ["legendOf"]);
const { timeOf } = load(["cursor"], ["timeOf"]);

const WORLD = {
  name: "hall", bounds: [0, 0, 4, 2], goal: null, walls: [[0, 0, 4, 0]], boxes: [], circles: [[1, 1, 0.2]],
  bodies: [{ name: "robot", kind: "robot", radius: 0.1, outline: [] }], lidar: { start: 0, step: 0.1, far: 3.5 },
};
const RUN = {
  version: 1, run: "0123456789ab", speed: 1, world: WORLD, stamps: [0, 50, 50], tracks: [[[0, 100, 100], [0, 0, 0], [0, 0, 0]]],
  scans: [], marks: [[100, "end", "over", null]], logs: [], topics: [], end: 0.1,
};

test("a world is parsed, and what is wrong in it is refused with what was expected", () => {
  assert.deepEqual(checkWorld(WORLD).circles, [[1, 1, 0.2]]);
  assert.throws(() => checkWorld({ ...WORLD, name: 3 }), { name: "TypeError", message: "a text was expected" });
  assert.throws(() => checkWorld({ ...WORLD, bounds: [4, 0, 0, 2] }), { message: "bounds was expected" });
  assert.throws(() => checkWorld({ ...WORLD, circles: [[1, 1, -1]] }), { message: "a size was expected" });
  assert.throws(() => checkWorld({ ...WORLD, walls: [[0, 0, 4]] }), { message: "4 numbers was expected" });
});

test("numbers, texts and lists have limits", () => {
  assert.throws(() => number(Infinity), { message: "a number was expected" });
  assert.throws(() => number("1"), { message: "a number was expected" });
  assert.throws(() => text("x".repeat(2001)), { message: "a text was expected" });
  assert.throws(() => list([1, 2, 3], 2, number), { message: "a list was expected" });
  assert.deepEqual(numbers(2)([1, 2]), [1, 2]);
});

test("a graph has boxes of known kinds, and arrows of whole curves", () => {
  const graph = { width: 1, height: 1, reasons: [], more: "", words: "", boxes: [], arrows: [] };
  assert.deepEqual(checkGraph(graph).boxes, []);
  const box = { kind: "door", name: "a", lines: [], place: [0, 0, 1, 1] };
  assert.throws(() => checkGraph({ ...graph, boxes: [box] }), { message: "a kind of box was expected" });
  const arrow = { gap: 0, rest: false, points: [0, 0, 1, 1], middle: [0, 0] };
  assert.throws(() => checkGraph({ ...graph, arrows: [arrow] }), { message: "a beginning and curves was expected" });
});

test("a value of a plot has no digits that its range hides", () => {
  assert.deepEqual([0.00000972, 0.12345, 3.7].map((value) => rounded(value, 4)), [0, 0.123, 3.7]);
  assert.deepEqual([rounded(0.00000972, 0.00002), rounded(5, 0), rounded(0, 0)], [0.00000972, 5, 0]);
});

test("the last item that is not later than a stamp is found", () => {
  assert.deepEqual([-1, 0, 0.5, 1, 9].map((stamp) => before([0, 1, 2], stamp)), [-1, 0, 0, 1, 2]);
  assert.equal(before([], 1), -1);
});

test("a view shows everything, and never more than that", () => {
  const size = { width: 400, height: 200 };
  assert.deepEqual(viewAt(size, [0, 0, 4, 2], 1, [9, 9]), { scale: 100, x: 2, y: 1 });
  assert.deepEqual(viewAt(size, [0, 0, 4, 2], 2, [1.5, 1]), { scale: 200, x: 1.5, y: 1 });
  assert.deepEqual(viewAt(size, [0, 0, 4, 2], 2, [0, 2]), { scale: 200, x: 1, y: 1.5 });
  assert.deepEqual(viewAt(size, [0, 0, 2, 2], 1.5, [0, 0]), { scale: 150, x: 1, y: 2 / 3 });
});

test("differences and unchanged values are decoded", () => {
  assert.deepEqual(cumulated([100, 1, -2], 0.5), [50, 50.5, 49.5]);
  assert.deepEqual(unchanged(["a", 0, "b", 0], 9, String), ["a", "a", "b", "b"]);
});

test("a run is parsed with its poses", () => {
  const run = checkRun(RUN);
  assert.deepEqual(run.stamps, [0, 0.05, 0.1]);
  assert.deepEqual(run.tracks[0][2], [0.2, 0, 0]);
  assert.equal(run.open, run.end);
});

for (const [what, change, message] of [
  ["another version", { version: 2 }, "version 1"],
  ["stamps that fall", { stamps: [50, -50, 0] }, "rising stamps"],
  ["a track too many", { tracks: [...RUN.tracks, ...RUN.tracks] }, "a track for each body"],
  ["a pose too few", { tracks: [[[0], [0], [0]]] }, "a pose for each stamp"],
  ["an unknown event", { marks: [[0, "party", "", null]] }, "a kind of event"],
]) {
  test(`a run with ${what} is refused`, () => {
    assert.throws(() => checkRun({ ...RUN, ...change }), { message: `${message} was expected` });
  });
}

test("the message of a topic at a time is the stored one before it", () => {
  const messages = { type: "std_msgs/msg/Float64", count: 5, stamps: [1, 2], texts: [["data: 0.5"], ["data: 0.7"]], curves: [{ name: "data", line: 0 }] };
  const at = (time) => topicAt({ name: "/level", messages }, time);
  assert.equal(at(0.5).text, "No message yet.");
  assert.equal(at(1.5).text, "data: 0.5\n# 2 of 5 messages are stored here");
  assert.deepEqual(at(2).curves[0].points, [[1, 0.5], [2, 0.7]]);
});

test("a replay that ends before its run says until when nothing moved", () => {
  assert.equal(restText(checkRun({ ...RUN, marks: [[120000, "end", "over", null]], end: 40 })), ", at rest until 120 s");
  assert.equal(restText(checkRun(RUN)), "");
});

test("a joint's curve has the messages of its driver", () => {
  const messages = [{ type: "sensor_msgs/msg/JointState", count: 3, stamps: [1000, 2000, 3000], texts: [["a"], ["b"], ["c"]], curves: [["elbow_joint position", [0.5, null, 0.7]]] }];
  const run = checkRun({ ...RUN, topics: [["/joint_states", "3", ""]], messages });
  assert.deepEqual(topicAt(run.topics[0], 3).curves, [{ name: "elbow_joint position", along: "s", points: [[1, 0.5], [3, 0.7]] }]);
  messages[0].curves[0][1].pop();
  assert.throws(() => checkRun({ ...RUN, topics: [["/joint_states", "3", ""]], messages }), { message: "a value for each stamp was expected" });
});

test("the far end of an arm is computed from its last link", () => {
  const arm = { bodies: [{ kind: "link", outline: [[-0.1, 0], [1.1, 0]] }] };
  const path = tipPath(arm, [[0, 0, 0], [1, 2, Math.PI / 2]]);
  assert.deepEqual(path.map((point) => point.map((value) => Math.round(value * 100) / 100)), [[1, 0], [1, 3]]);
  assert.equal(tipPath(WORLD, [[0, 0, 0]]), null);
});

test("strokes are visible from their first point until they are erased", () => {
  const points = [[1, 0, 0], [2, 1, 0], [3, 2, 0]];
  const drawing = { grounds: [{ stamp: 0, color: "#000000" }], strokes: [{ color: "#ffffff", width: 1, erased: 4, points }] };
  assert.deepEqual([0, 1, 2.5, 4].map((time) => visibleAt(drawing, time).strokes.map((stroke) => stroke.points.length)), [[], [1], [2], []]);
});

test("a legend names what is in a world besides walls and one robot", () => {
  const look = { robots: ["blue", "violet"], goal: "gold", edge: "gray", person: "red", rim: "brown" };
  const world = { ...WORLD, goal: [1, 1], places: [["desk", [0, 0]]], bodies: [...WORLD.bodies, { name: "visitor", kind: "person" }] };
  assert.deepEqual(legendOf(world, look).map(([, color, name]) => `${color} ${name}`), ["gold goal", "gray obstacle", "red person", "brown named place"]);
  assert.deepEqual(legendOf({ ...WORLD, circles: [], places: [] }, look), []);
});

test("a link with a time has the key of its run", () => {
  const link = (href) => ({ getAttribute: () => href });
  assert.deepEqual(timeOf(link("#run-0123456789ab-3.16")), { run: "0123456789ab", time: 3.16 });
  assert.equal(timeOf(link("#somewhere")), null);
  assert.equal(timeOf(null), null);
});

test("a notebook is saved once at a time, and everything that changed is saved", async () => {
  let running = 0, most = 0, count = 0;
  const context = { async save() { count++; most = Math.max(most, ++running); await null; running--; } };
  await Promise.all(Array.from({ length: 8 }, () => save(context)));
  assert.deepEqual([most, count], [1, 2]);
  await save(context);
  assert.equal(count, 3);
  const failing = { save: () => Promise.reject(new Error("disk full")) };
  await Promise.all([save(failing), save(failing)]);
  await save({ isDisposed: true });
});

test("a robot that comes near the goal has reached it, and the replay marks the moment", () => {
  const world = checkWorld({ ...WORLD, goal: [3, 1] });
  assert.equal(isAtGoal(world, [[2.8, 1, 0]]), true);
  assert.equal(isAtGoal(world, [[2.7, 1, 0]]), false);
  assert.equal(isAtGoal(checkWorld(WORLD), [[3, 1, 0]]), false);
  assert.equal(isAtGoal(world, [null]), false);
  const run = { ...RUN, world: { ...WORLD, goal: [0.19, 0] }, tracks: [[[-1000, 500, 500], [0, 0, 0], [0, 0, 0]]] };
  const { reached, marks } = checkRun(run);
  assert.equal(reached, 0.1);
  assert.deepEqual(marks.map(({ kind, words }) => [kind, words]), [["end", "over"], ["goal", "Reached the star in 0.1 s."]]);
  assert.equal(checkRun(RUN).reached, null);
});

test("tabs of lessons, exercises and pages of the bridge have names of their own", () => {
  assert.equal(tabName("course/04_actions/driving.ipynb"), "4 Actions: driving");
  assert.equal(tabName("work/exercises/01_nodes/nodes.ipynb"), "1 Nodes: exercises");
  assert.equal(tabName("exercises/11b_launching/launching.ipynb"), "11b Launching: exercises");
  assert.equal(tabName("course/bridge/05_security.ipynb"), "B5 Security");
  assert.equal(tabName("notes.ipynb"), "");
});

test("after the notebooks of a lesson come its assignments, and then the next lesson", async () => {
  const files = ["course/11_packages/lesson", "course/11_packages/launching", "exercises/11_packages/packages",
    "exercises/11b_launching/launching", "course/12_safety/lesson", "exercises/12_safety/safety"].map((each) => `${each}.ipynb`);
  const get = async (folder) => {
    const names = new Set(files.filter((each) => each.startsWith(`${folder}/`)).map((each) => each.slice(folder.length + 1).split("/")[0]));
    const type = (name) => (name.endsWith(".ipynb") ? "notebook" : "directory");
    return { content: [...names].map((name) => ({ name, type: type(name), path: `${folder}/${name}` })) };
  };
  const following = await Promise.all(files.map((path) => nextNotebook({ get }, path)));
  assert.deepEqual(following, [...files.slice(1), undefined]);
});

test("layers are parsed, and each topic shows its newest one", () => {
  const grid = { stamp: 0, topic: "/map", kind: "map", data: { width: 2, place: [0, 0, 0.5], runs: [[0, 3], [100, 1]] } };
  const plan = (stamp) => ({ stamp, topic: "/plan", kind: "plan", data: [[0, 0], [stamp, 1]] });
  const layers = [grid, plan(1000), plan(2000)].map(checkLayer);
  assert.deepEqual(layers[0].data.cells, [0, 0, 0, 100]);
  assert.deepEqual(layersAt(layers, 0.5).map(({ topic }) => topic), ["/map"]);
  assert.deepEqual(layersAt(layers, 2.5).map(({ stamp }) => stamp), [0, 2]);
  assert.throws(() => checkLayer({ ...grid, kind: "fog" }), { message: "a kind of layer was expected" });
  assert.throws(() => checkLayer({ ...grid, data: { ...grid.data, runs: [[0, 3e5]] } }));
});

test("a pose between two that were published lies between them, and turns the shorter way", () => {
  const columns = [[0, 1000], [0, 0], [3100, 83], [0, 0], [0, 0], [40000, 0]];
  const track = checkBelief({ topic: "/odom", kind: "pose", name: "", stamps: [1000, 1000], columns });
  const [pose] = beliefsAt([track], 1.5);
  assert.deepEqual([pose.data[0], pose.data[5]], [0.5, 0.04]);
  assert.ok(Math.abs(pose.data[2] - 3.1415) < 1e-6);
  assert.deepEqual(beliefsAt([track], 0.5), []);
  assert.equal(beliefsAt([track], 9)[0].data[0], 1);
  assert.throws(() => checkBelief({ topic: "/odom", kind: "map", name: "", stamps: [], columns: [] }), { message: "a pose or a frame was expected" });
  assert.throws(() => checkBelief({ topic: "/odom", kind: "pose", name: "", stamps: [0], columns }), { message: "a value for each stamp was expected" });
});

test("a frame whose quaternion changes its sign does not turn", () => {
  const columns = [[0, 0], [0, 0], [0, 0], [0, 0], [1000, -2000], [0, 0]];
  const [frame] = beliefsAt([checkBelief({ topic: "/tf", kind: "frames", name: "odom", stamps: [0, 1000], columns })], 0.5);
  assert.deepEqual([frame.name, frame.data[4]], ["odom", 1]);
});

test("the axes of a frame are seen from above", () => {
  const rounded = (axes) => axes.map((axis) => axis.map((value) => Math.round(value * 1e6) / 1e6 + 0));
  assert.deepEqual(rounded(axesOf([0, 0, Math.SQRT1_2, Math.SQRT1_2])), [[0, 1], [-1, 0], [0, 0]]);
  assert.deepEqual(rounded(axesOf([-0.5, 0.5, -0.5, 0.5])), [[0, -1], [0, 0], [1, 0]]); // a camera's: z ahead, x right, y down
});

test("the ellipse of a covariance has the axes of its eigenvectors", () => {
  assert.deepEqual(ellipseOf(0.04, 0, 0.01), [0.2, 0.1, 0]);
  const [long, short, turn] = ellipseOf(0.025, 0.015, 0.025);
  assert.ok(Math.abs(long - 0.2) < 1e-9 && Math.abs(short - 0.1) < 1e-9 && Math.abs(turn - Math.PI / 4) < 1e-9);
});

test("maps, plans and goals are shown until the reader hides them; poses, clouds, frames and images only when asked for", () => {
  const shows = (kind) => LayerChoice.prototype.shows.call({ chosen: new Map([["/b", true]]) }, { topic: "/a", kind });
  assert.deepEqual(["map", "plan", "goal", "pose", "cloud", "frames", "image"].map(shows), [true, true, true, false, false, false, false]);
  assert.equal(LayerChoice.prototype.shows.call({ chosen: new Map([["/b", false]]) }, { topic: "/b", kind: "map" }), false);
  const cloud = { topic: "/particle_cloud", kind: "cloud" };
  assert.deepEqual([[], [["/particle_cloud", false]]].map((chosen) => LayerChoice.prototype.shows.call({ chosen: new Map(chosen) }, cloud)), [true, false]);
});

test("an image that is no base64 is refused", () => {
  const image = { stamp: 0, topic: "/image", kind: "image", data: { width: 4, height: 3, webp: "UklGRg==" } };
  assert.equal(checkLayer(image).data.webp, "UklGRg==");
  assert.throws(() => checkLayer({ ...image, data: { ...image.data, webp: '" onload="' } }), { message: "an image was expected" });
});

test("a click into a topic's plot is a time of the replay", () => {
  const { Topic } = load(["topic"], ["Topic"]);
  const at = (px) => Topic.prototype.timeAt.call({ range: [0, 20], canvas: { clientWidth: 108 } }, px);
  assert.deepEqual([0, 4, 54, 104, 108].map(at), [0, 0, 10, 20, 20]);
});

test("a camera's topic has the image of the time", () => {
  const image = (stamp, webp) => checkLayer({ stamp, topic: "/image", kind: "image", data: { width: 4, height: 3, webp } });
  const messages = { type: "sensor_msgs/msg/Image", count: 0, stamps: [], texts: [], curves: [] };
  const at = (time, name = "/image") => topicAt({ name, messages }, time, [image(1000, "AA"), image(2000, "BB")]).image?.webp;
  assert.deepEqual([at(0.5), at(1.5), at(2), at(2, "/other")], [undefined, "AA", "BB", undefined]);
});

test("the states of widgets are kept that an output names, and of those that they are made of", () => {
  const view = (id) => ({ data: { "application/vnd.jupyter.widget-view+json": { model_id: id } } });
  const states = {
    box: { state: { children: ["IPY_MODEL_slider", "IPY_MODEL_output"], layout: "IPY_MODEL_lost" } }, slider: { state: { value: 3 } },
    output: { state: { outputs: [view("inner")] } }, inner: { state: { box: "IPY_MODEL_box" } }, other: { state: {} },
  };
  assert.deepEqual(new Set(Object.keys(shown([[view("box")], []], states))), new Set(["box", "slider", "output", "inner"]));
  assert.deepEqual(shown([[view("unknown")]], states), {});
});
