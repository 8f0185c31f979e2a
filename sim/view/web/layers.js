// Layers of ../layers.py, what nodes published about the world: parsed, and which of them a reader has chosen to see.

/** @typedef {ReturnType<typeof checkLayer>} Layer */

const MOST_CELLS = 2e5;
const QUIET = ["pose", "cloud", "image", "frames"]; // drawn where the reader asks for them
const OPEN = "/particle_cloud"; // a quiet layer that is drawn until the reader hides it
const BASE64 = /^[A-Za-z0-9+/=]*$/;
const DATA = {
  map: ({ width, place, runs }) => {
    const checked = list(runs, MOST_CELLS, numbers(2));
    const count = checked.reduce((sum, [, length]) => sum + size(length), 0);
    if (!size(width) || count > MOST_CELLS || count % width) refuse("a map of whole rows");
    return { width, place: numbers(3)(place), cells: checked.flatMap(([value, length]) => Array(length).fill(value)) };
  },
  plan: (points) => list(points, 1000, numbers(2)),
  goal: numbers(3),
  pose: numbers(6), // x, y, yaw, and the covariance xx, xy, yy
  cloud: (poses) => list(poses, 1000, numbers(3)),
  frames: numbers(6), // x, y and a quaternion
  points: ({ color, places }) => ({ color: size(color), places: list(places, 5000, numbers(2)) }), // to mark
  image: ({ width, height, webp }) => ({
    width: size(width), height: size(height), webp: BASE64.test(text(webp, 1e5)) ? webp : refuse("an image"),
  }),
};

/** Parses a layer: what a topic showed from a moment (s) on. */
function checkLayer({ stamp, topic, kind, data, name = "" }) {
  if (!Object.hasOwn(DATA, kind)) refuse("a kind of layer");
  return { stamp: number(stamp, 1e9) * 1e-3, topic: text(topic), kind, name: text(name), data: DATA[kind](data), image: null };
}

/** The colors of points that are marked: usual ones, and special ones. */
const marksOf = (look) => [look.edge, look.contact];

/** The address of an image's data. */
const webpAddress = ({ webp }) => `data:image/webp;base64,${webp}`;

/** Which layers a picture shows, with a button for each in `root`; `change` is called after each click. */
class LayerChoice {
  constructor(change) {
    this.change = change;
    this.chosen = new Map(); // topic -> whether it is shown, where the reader has said so
    this.buttons = new Map();
    this.root = make("span", { className: "layers" });
  }

  /** @param {{ topic: string, kind: string }} layer */
  shows({ topic, kind }) {
    return this.chosen.get(topic) ?? (!QUIET.includes(kind) || topic === OPEN);
  }

  /** Offer these layers. @param {{ topic: string, kind: string, data?: any }[]} layers */
  offer(layers, look) {
    const signs = {
      map: ["▦", look.edge], plan: ["—", look.plan], goal: ["➤", look.aim], pose: ["○", look.belief], cloud: ["∴", look.belief],
      frames: ["∟", look.axes[0]], image: ["▣", look.ink],
    };
    for (const layer of layers) {
      const { topic, kind } = layer, shown = this.shows(layer);
      const [sign, color] = kind === "points" ? ["•", marksOf(look)[layer.data.color]] : signs[kind];
      if (!this.buttons.has(topic)) this.add(layer);
      const element = this.buttons.get(topic);
      element.firstChild.textContent = sign;
      element.firstChild.style.color = shown ? color : "inherit";
      element.setAttribute("aria-pressed", String(shown));
      element.title = `${shown ? "Hide" : "Show"} ${topic} in the picture`;
    }
  }

  add(layer) {
    const element = make("button", { type: "button", className: "layer" }, make("b", { ariaHidden: "true" }), ` ${layer.topic}`);
    element.addEventListener("click", () => { this.chosen.set(layer.topic, !this.shows(layer)); this.change(); });
    this.buttons.set(layer.topic, element);
    this.root.append(element);
  }
}
