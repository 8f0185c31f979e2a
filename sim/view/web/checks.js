// Validates data from outside before it is drawn; invalid data throws a TypeError.

/** @returns {never} */
const refuse = (wanted) => { throw new TypeError(`${wanted} was expected`); };
/** @returns {number} */
const number = (value, most = 1e6) =>
  typeof value === "number" && Math.abs(value) <= most ? value : refuse("a number");
const size = (value) => (number(value) >= 0 ? value : refuse("a size"));
/** @returns {string} */
const text = (value, most = 2000) =>
  typeof value === "string" && value.length <= most ? value : refuse("a text");
/** @template T @param {any} value @param {number} most @param {(item: any) => T} each @returns {T[]} */
const list = (value, most, each) =>
  Array.isArray(value) && value.length <= most ? value.map((item) => each(item)) : refuse("a list");
/** @typedef {any} Numbers an array of as many numbers as were requested, which is checked at run time */
/** @param {number} count @returns {(value: any) => Numbers} */
const numbers = (count) => (value) => {
  const all = list(value, count, (item) => number(item));
  return all.length === count ? all : refuse(`${count} numbers`);
};
const polygon = (value) => list(value, 100, numbers(2));
/** @param {Numbers} bounds @returns {[number, number, number, number]} */
const box = ([left, bottom, right, top]) =>
  left < right && bottom < top ? [left, bottom, right, top] : refuse("bounds");
/** @param {Numbers} circle @returns {[number, number, number]} */
const disc = ([x, y, radius]) => [x, y, size(radius)];

/** @typedef {ReturnType<typeof checkWorld>} World */
/** @typedef {ReturnType<typeof checkGraph>} GraphLayout */

/** Parses the data of ../world_data.py; throws a TypeError if it is invalid. */
function checkWorld(world) {
  return {
    name: text(world.name),
    bounds: box(numbers(4)(world.bounds)),
    goal: world.goal === null ? null : numbers(2)(world.goal),
    walls: list(world.walls, 20000, numbers(4)),
    boxes: list(world.boxes, 5000, polygon),
    circles: list(world.circles, 5000, (circle) => disc(numbers(3)(circle))),
    bodies: list(world.bodies, 500, (body) => ({
      name: text(body.name), kind: text(body.kind), radius: size(body.radius), outline: polygon(body.outline),
    })),
    places: list(Object.entries(world.places ?? {}), 100, ([name, place]) => [text(name), numbers(2)(place)]),
    lidar: { start: number(world.lidar.start), step: number(world.lidar.step), far: number(world.lidar.far) },
  };
}

const BOXES = ["node", "course", "topic", "service", "action", "rest"];

/** Parses the data of ../graph_data.py; throws a TypeError if it is invalid. */
function checkGraph(graph) {
  const reasons = list(graph.reasons, 50, (reason) => text(reason));
  const points = (values) => {
    const all = list(values, 1000, (value) => number(value));
    return all.length >= 8 && all.length % 6 === 2 ? all : refuse("a beginning and curves");
  };
  return {
    width: size(graph.width), height: size(graph.height), reasons, more: text(graph.more), words: text(graph.words, 20000),
    boxes: list(graph.boxes, 500, (box) => ({
      kind: BOXES.includes(box.kind) ? box.kind : refuse("a kind of box"), name: text(box.name),
      lines: list(box.lines, 50, (line) => text(line)), place: numbers(4)(box.place),
    })),
    arrows: list(graph.arrows, 2000, (arrow) => ({
      gap: size(arrow.gap), rest: Boolean(arrow.rest), points: points(arrow.points), middle: numbers(2)(arrow.middle),
    })),
  };
}
