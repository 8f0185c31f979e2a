// Maps, plans and goals of ../layers.py: parsed, and drawn into the picture of a world.

/** @typedef {ReturnType<typeof checkLayer>} Layer */

const MOST_CELLS = 2e5;
const DATA = {
  map: ({ width, place, runs }) => {
    const checked = list(runs, MOST_CELLS, numbers(2));
    const count = checked.reduce((sum, [, length]) => sum + size(length), 0);
    if (!size(width) || count > MOST_CELLS || count % width) refuse("a map of whole rows");
    return { width, place: numbers(3)(place), cells: checked.flatMap(([value, length]) => Array(length).fill(value)) };
  },
  plan: (points) => list(points, 1000, numbers(2)),
  goal: numbers(3),
};

/** Parses a layer: what a topic showed from a moment (s) on. */
function checkLayer({ stamp, topic, kind, data }) {
  if (!Object.hasOwn(DATA, kind)) refuse("a kind of layer");
  return { stamp: number(stamp, 1e9) * 1e-3, topic: text(topic), kind, data: DATA[kind](data), image: null };
}

/** Of layers in the order of time, each topic's newest at a time (s). @param {Layer[]} layers @returns {Layer[]} */
function layersAt(layers, time) {
  return [...new Map(layers.slice(0, before(layers, time, stampOf) + 1).map((layer) => [layer.topic, layer])).values()];
}

/** Signs, colors and names of layers for a legend. @param {Layer[]} layers */
function legendOfLayers(layers, look) {
  const signs = { map: ["▦", look.edge], plan: ["—", look.plan], goal: ["➤", look.aim] };
  return [...new Map(layers.map(({ topic, kind }) => [topic, [...signs[kind], topic]])).values()];
}

/** Draw maps below all else. @param {WorldCanvas} picture @param {Layer[]} layers */
function paintMaps(picture, layers) {
  const c = picture.context;
  for (const layer of layers.filter(({ kind }) => kind === "map")) {
    const { width, place: [x, y, cell], cells } = layer.data, height = Math.ceil(cells.length / width);
    if (layer.image?.look !== picture.look) layer.image = { look: picture.look, canvas: mapImage(layer.data, height, picture.look) };
    c.imageSmoothingEnabled = false;
    const [left, top] = picture.at(x, y + height * cell);
    c.drawImage(layer.image.canvas, left, top, width * cell * picture.scale, height * cell * picture.scale);
  }
}

/** An image with a pixel for each cell: free ones are clear, those with a cost blue, unknown ones gray. */
function mapImage({ width, cells }, height, look) {
  const canvas = make("canvas", { width, height }), context = canvas.getContext("2d");
  cells.forEach((value, index) => {
    if (value === 0) return;
    context.globalAlpha = value < 0 ? 0.16 : value >= 100 ? 0.75 : 0.1 + value / 250;
    context.fillStyle = value < 0 || value >= 100 ? look.wall : look.robots[0];
    context.fillRect(index % width, height - 1 - Math.floor(index / width), 1, 1);
  });
  return canvas;
}

/** Draw plans and goals over the floor. @param {WorldCanvas} picture @param {Layer[]} layers */
function paintPlans(picture, layers) {
  const c = picture.context;
  for (const { kind, data } of layers) {
    if (kind === "plan" && data.length) picture.line(data, picture.look.plan, 4);
    if (kind !== "goal") continue;
    const [px, py] = picture.at(data[0], data[1]);
    const turn = (angle, reach) => [px + reach * Math.cos(data[2] + angle), py - reach * Math.sin(data[2] + angle)];
    c.beginPath();
    for (const [angle, reach] of [[0, 15], [2.6, 10], [Math.PI, 4], [-2.6, 10]]) c.lineTo(...turn(angle, reach));
    c.closePath();
    c.fillStyle = picture.look.aim;
    c.fill();
  }
}
