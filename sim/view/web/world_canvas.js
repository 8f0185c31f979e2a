// Draws a world from above, or from the side: meters, x to the right, y up. Used by the live view and the replay.

const MARGIN = 0.2; // m around the bounds
const MAX_HEIGHT = 500; // CSS pixels
const LEAST_HEIGHT = 140, TOPICS = 40; // px; in a panel, at least of the picture, and what is left for topics
const LEAST_SHARE = 0.45; // of a panel's height, at least for the picture
const LEAST_ROBOT = 7; // px, the radius of a robot that would be smaller in a large world
const GOAL_REACH = 0.25; // m, from a robot's center to the goal that it has reached
const FAINT = 0.35; // opacity of a body where it started
const STEPS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 1000, 10000];

/** Whether a robot or turtle of this world is at its goal. @param {World} world @param {(Pose | null)[]} poses */
function isAtGoal(world, poses) {
  return world.goal !== null && poses.some((pose, index) => pose && ["robot", "turtle"].includes(world.bodies[index]?.kind)
    && Math.hypot(pose[0] - world.goal[0], pose[1] - world.goal[1]) <= GOAL_REACH);
}

/** The announcement of that moment (s). */
const reachedText = (stamp) => `Reached the star in ${stamp.toFixed(1)} s.`;

/** The distance of a machine's far end from the pose of its last link; null unless it is made of links. */
function tipReach(world) {
  if (!world?.bodies.length || world.bodies.some(({ kind }) => kind !== "link")) return null;
  const along = world.bodies.at(-1).outline.map(([u]) => u);
  return Math.min(...along) + Math.max(...along); // a link reaches as far behind its joint as beyond the tip
}

/** Where the far end of a machine's last link is at these poses of that link; null unless it is made of links. */
function tipPath(world, poses) {
  const reach = tipReach(world);
  return reach === null ? null : poses.map(([x, y, yaw]) => [x + reach * Math.cos(yaw), y + reach * Math.sin(yaw)]);
}

/** @typedef {number[]} Pose x, y (m) and yaw (rad) */
/** @typedef {number[][]} Path points or poses */
/** @typedef {{ pose: Pose, ranges: ArrayLike<number>, start: number, step: number, far: number }} LaserScan */
/**
 * @typedef {{ poses: Pose[], scan: LaserScan | null, trails: Path[], ahead: Path[], contacts: number[][], starts?: Pose[],
 *   drawn?: any, tip?: Path, tipAhead?: Path, reached?: boolean, layers?: Layer[] }} Frame
 */

/**
 * A canvas that shows the world and adapts to the size of its stage.
 *
 * `frame` is the state to show: poses of all bodies; scan {pose, ranges, start, step, far} or null; trails, a list
 * of points or null for each body; ahead, the same for their future paths; contacts, points; with pens also drawn,
 * from ./drawing.js; starts, poses to draw faintly; of an arm tip and tipAhead, the paths of its far end; reached,
 * whether a robot has been at the goal; layers, from ./layers.js.
 * There may be more turtles than at the start.
 */
class WorldCanvas {
  /** @param {HTMLElement} stage @param {World} world */
  constructor(stage, world) {
    this.stage = stage;
    this.world = world;
    this.canvas = make("canvas", { tabIndex: 0, role: "img", "aria-label": `The world ${world.name}` });
    this.canvas.dataset.lmSuppressShortcuts = "true";
    this.context = this.canvas.getContext("2d");
    /** @type {Frame} */
    this.frame = { poses: [], scan: null, trails: [], ahead: [], contacts: [] };
    this.request = 0;
    this.images = new Map(); // topic -> the newest image that has loaded
    const [left, bottom, right, top] = world.bounds;
    this.shown = [left - MARGIN, bottom - MARGIN, right + MARGIN, top + MARGIN];
    stage.append(this.canvas);
    this.camera = new Camera(this, world.bodies.findIndex(({ kind }) => kind === "robot" || kind === "turtle"));
    stage.append(this.camera.root);
    this.sizes = new ResizeObserver(() => { this.fit(); this.paint(); }); // at once: a new size clears the canvas
    this.sizes.observe(stage);
    this.frameless = null; // a panel of a given height, which the picture has to fit
    onTheme(stage, () => this.requestPaint());
    this.fit();
  }

  close() {
    this.sizes.disconnect();
    cancelAnimationFrame(this.request);
  }

  /** Extend the picture, by whole meters, so that it includes a body at this pose. @param {World["bodies"][number]} body @param {Pose} pose */
  include(body, [x, y]) {
    const reach = Math.max(body.radius, ...body.outline.map(([u, v]) => Math.hypot(u, v)));
    const [left, bottom, right, top] = this.shown;
    if (x - reach >= left && x + reach <= right && y - reach >= bottom && y + reach <= top) return;
    this.shown = [
      Math.min(left, left - Math.ceil(left - x + reach)), Math.min(bottom, bottom - Math.ceil(bottom - y + reach)),
      Math.max(right, right + Math.ceil(x + reach - right)), Math.max(top, top + Math.ceil(y + reach - top)),
    ];
    this.grown = true;
    this.requestPaint();
  }

  /** What is as wide as the picture: in a replay its controls, too, and all of it where there is nothing else. */
  get column() {
    return /** @type {HTMLElement} */ (this.stage.closest(".ros2-narrow") ?? this.stage.closest(".ros2-column") ?? this.stage);
  }

  /** Look for the panel around, which is there once the stage has been added to the page. */
  findPanel() {
    if (this.frameless) return;
    this.frameless = /** @type {HTMLElement} */ (this.stage.closest(".ros2-course-robot"));
    if (!this.frameless) return;
    this.column.style.maxWidth = "";
    this.sizes.observe(this.frameless);
  }

  fit() {
    this.findPanel();
    this.grown = false;
    const [left, bottom, right, top] = this.shown;
    const shape = Math.min(Math.max((top - bottom) / (right - left), 0.2), 1.1);
    if (!this.frameless) this.column.style.maxWidth = `${Math.round(MAX_HEIGHT / shape)}px`;
    this.width = this.stage.clientWidth;
    this.most = this.mostHeight();
    this.height = Math.round(Math.min(this.width * shape, this.most));
    const sharp = window.devicePixelRatio || 1;
    const size = [this.width, this.height].map((length) => Math.round(length * sharp));
    if (this.canvas.width !== size[0] || this.canvas.height !== size[1]) [this.canvas.width, this.canvas.height] = size;
    this.canvas.style.height = `${this.height}px`;
    this.requestPaint();
  }

  /** The height (px) that the panel around leaves for the picture, beside the controls and the numbers. */
  mostHeight() {
    if (!this.frameless) return Infinity;
    const others = /** @type {HTMLElement[]} */ ([...this.stage.parentElement.children]).filter((each) => each.matches(".how, .bar, .legend, .warning, .say, .numbers, .pad"));
    const buttons = this.stage.offsetHeight - this.canvas.offsetHeight; // below the picture
    const taken = others.reduce((sum, each) => sum + each.offsetHeight, buttons);
    const room = this.frameless.clientHeight;
    return Math.max(room - taken - TOPICS, LEAST_SHARE * room, LEAST_HEIGHT);
  }

  /** Draw the newest frame with the browser's next repaint. */
  requestPaint() {
    if (!this.request) this.request = requestAnimationFrame(() => { this.request = 0; this.paint(); });
  }

  /** Whether the panel around, or what else is in it, has changed its size. */
  isOutgrown() {
    this.findPanel();
    return this.frameless && (this.stage.clientWidth !== this.width || this.mostHeight() !== this.most);
  }

  at(x, y) {
    return [this.x0 + this.scale * x, this.y0 - this.scale * y];
  }

  paint() {
    if (this.grown || this.isOutgrown()) this.fit();
    if (!this.width) return; // invisible, for example in a collapsed part of the page
    const { scale, x, y } = this.camera.view();
    this.scale = scale;
    this.x0 = this.width / 2 - scale * x;
    this.y0 = this.height / 2 + scale * y;
    const sharp = window.devicePixelRatio || 1;
    this.look = colors(this.stage);
    this.stage.style.background = this.look.ground; // live, numbers may be scrolled below its buttons
    this.context.setTransform(sharp, 0, 0, sharp, 0, 0);
    this.context.lineJoin = this.context.lineCap = "round";
    this.floor();
    paintMaps(this, this.frame.layers ?? []);
    const hits = this.rays();
    this.obstacles();
    paintPlans(this, this.frame.layers ?? []);
    this.signs();
    for (const { color, width, points } of this.frame.drawn?.strokes ?? []) {
      this.line(points, color, Math.max(width * this.scale, 1));
    }
    this.context.fillStyle = this.look.hit;
    for (const [px, py] of hits) this.context.fillRect(px - 1.5, py - 1.5, 3, 3);
    this.paths();
    this.context.globalAlpha = FAINT;
    this.frame.starts?.forEach((pose, index) => this.body(this.bodyOf(index), pose, index));
    this.context.globalAlpha = 1;
    this.frame.poses.forEach((pose, index) => this.body(this.bodyOf(index), pose, index));
    this.contacts();
    paintBeliefs(this, this.frame.layers ?? []);
    this.ruler();
  }

  line(points, color, width, close = false) {
    const c = this.context;
    c.beginPath();
    for (const [x, y] of points) c.lineTo(...this.at(x, y));
    if (close) c.closePath();
    c.strokeStyle = color;
    c.lineWidth = width;
    c.stroke();
  }

  area(points, fill, edge) {
    this.line(points, edge, 1.5, true);
    this.context.fillStyle = fill;
    this.context.fill();
  }

  disc(x, y, radius, fill, edge, width = 1.5) {
    const c = this.context;
    c.beginPath();
    c.arc(...this.at(x, y), radius * this.scale, 0, 7);
    c.fillStyle = fill;
    c.fill();
    c.strokeStyle = edge;
    c.lineWidth = width;
    c.stroke();
  }

  floor() {
    const c = this.context;
    const [left, bottom, right, top] = this.world.bounds;
    c.fillStyle = this.look.ground;
    c.fillRect(0, 0, this.width, this.height);
    c.fillStyle = this.frame.drawn?.ground ?? this.look.floor;
    c.fillRect(...this.at(left, top), this.scale * (right - left), this.scale * (top - bottom));
    this.unit = STEPS.find((step) => step * this.scale > 44) || STEPS.at(-1);
    c.beginPath();
    for (let x = Math.ceil(-this.x0 / this.scale / this.unit); ; x++) {
      const [px] = this.at(x * this.unit, 0);
      if (px > this.width) break;
      c.moveTo(px, 0);
      c.lineTo(px, this.height);
    }
    for (let y = Math.ceil((this.y0 - this.height) / this.scale / this.unit); ; y++) {
      const [, py] = this.at(0, y * this.unit);
      if (py < 0) break;
      c.moveTo(0, py);
      c.lineTo(this.width, py);
    }
    c.strokeStyle = this.look.grid;
    c.lineWidth = 1;
    c.stroke();
  }

  /**
   * Draw the rays of the scan, and return the points that they hit.
   * inf: nothing within range; nan and -inf: no measurement (REP-117).
   */
  rays() {
    const { scan } = this.frame;
    if (!scan) return [];
    const c = this.context;
    const [x, y, yaw] = scan.pose;
    const areas = { true: new Path2D(), false: new Path2D() };
    const hits = [];
    const center = this.at(x, y);
    // Neighboring rays make one area: lines would interfere with the pixels.
    const ends = Array.from(scan.ranges, (range, ray) => {
      if (Number.isNaN(range) || range === -Infinity) return null;
      const angle = yaw + scan.start + ray * scan.step, hit = range !== Infinity, reach = hit ? range : scan.far;
      const end = this.at(x + reach * Math.cos(angle), y + reach * Math.sin(angle));
      if (hit) hits.push(end);
      return { hit, end };
    });
    const full = Math.abs(ends.length * scan.step) > 2 * Math.PI - 1.5 * Math.abs(scan.step);
    ends.forEach((ray, index) => {
      const next = index + 1 < ends.length ? ends[index + 1] : full ? ends[0] : null;
      if (!ray || !next) return;
      const area = areas[ray.hit && next.hit];
      area.moveTo(...center);
      area.lineTo(...ray.end);
      area.lineTo(...next.end);
      area.closePath();
    });
    c.fillStyle = this.look.far;
    c.fill(areas.false);
    c.fillStyle = this.look.ray;
    c.fill(areas.true);
    return hits;
  }

  obstacles() {
    const { look, world } = this;
    for (const box of world.boxes) this.area(box, look.solid, look.edge);
    for (const [x, y, radius] of world.circles) this.disc(x, y, radius, look.solid, look.edge);
    const c = this.context;
    c.beginPath();
    for (const [x0, y0, x1, y1] of world.walls) {
      c.moveTo(...this.at(x0, y0));
      c.lineTo(...this.at(x1, y1));
    }
    c.strokeStyle = look.wall;
    c.lineWidth = 3;
    c.stroke();
  }

  /** The goal and the named locations. */
  signs() {
    const { world } = this;
    if (world.goal) this.star(...world.goal, this.frame.reached);
    const taken = [];
    for (const [name, place] of world.places) this.place(name, ...this.at(...place), taken);
  }

  /** A named location: a small cross, and its name; `taken` lists the boxes of the names. */
  place(name, px, py, taken) {
    const c = this.context;
    c.beginPath();
    c.moveTo(px - 4, py);
    c.lineTo(px + 4, py);
    c.moveTo(px, py - 4);
    c.lineTo(px, py + 4);
    c.strokeStyle = this.look.rim;
    c.lineWidth = 1.5;
    c.stroke();
    this.label(name, px, py, taken);
  }

  /** A name beside a point, where no other name is. */
  label(name, px, py, taken) {
    const c = this.context;
    c.font = "10px system-ui, sans-serif";
    c.textAlign = "left";
    c.fillStyle = this.look.ink;
    const width = c.measureText(name).width, height = 11;
    const free = [[6, -4], [6, 12], [-width - 6, -4], [-width - 6, 12]].find(([dx, dy]) => {
      const box = [px + dx, py + dy - height, px + dx + width, py + dy];
      return box[0] >= 0 && box[2] <= this.width && !taken.some((other) =>
        box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3]);
    });
    if (!free) return; // no room for another name here
    const [dx, dy] = free;
    taken.push([px + dx, py + dy - height, px + dx + width, py + dy]);
    c.fillText(name, px + dx, py + dy);
  }

  /** The goal: an empty star, and once it was reached a full one in a ring. */
  star(x, y, reached) {
    const [px, py] = this.at(x, y);
    const c = this.context;
    c.beginPath();
    for (let tip = 0; tip < 10; tip++) {
      const reach = tip % 2 ? 4.5 : 11;
      const angle = Math.PI * (tip / 5 - 0.5);
      c.lineTo(px + reach * Math.cos(angle), py + reach * Math.sin(angle));
    }
    c.closePath();
    c.fillStyle = this.look.goal;
    c.globalAlpha = reached ? 1 : 0.35;
    c.fill();
    c.globalAlpha = 1;
    c.strokeStyle = this.look.rim;
    c.lineWidth = 1.5;
    c.stroke();
    if (!reached) return;
    c.beginPath();
    c.arc(px, py, 15, 0, 2 * Math.PI);
    c.strokeStyle = this.look.goal;
    c.lineWidth = 3;
    c.stroke();
  }

  paths() {
    if (this.frame.tipAhead) this.line(this.frame.tipAhead, this.look.ahead, 2);
    if (this.frame.tip) this.line(this.frame.tip, this.look.robots[0], 2.25);
    this.world.bodies.forEach((body, index) => {
      if (body.kind === "ghost" && this.frame.trails[index]) this.line(this.frame.trails[index], this.look.ghost, 2);
      if (body.kind !== "robot") return;
      if (this.frame.ahead[index]) this.line(this.frame.ahead[index], this.look.ahead, 2);
      if (this.frame.trails[index]) this.line(this.frame.trails[index], this.robot(index), 2.25);
    });
  }

  robot(index) {
    const robots = this.world.bodies.filter((body) => body.kind === "robot");
    return this.look.robots[robots.indexOf(this.world.bodies[index]) % this.look.robots.length];
  }

  /** A moving body, by its index; further turtles look like the first. */
  bodyOf(index) {
    return this.world.bodies[index] ?? this.world.bodies[0];
  }

  body(body, pose, index) {
    if (!pose) return;
    const [x, y, yaw] = pose;
    const cos = Math.cos(yaw), sin = Math.sin(yaw);
    const placed = (u, v) => [x + cos * u - sin * v, y + sin * u + cos * v];
    const robot = body.kind === "robot";
    const radius = robot && body.radius ? Math.max(body.radius, LEAST_ROBOT / this.scale) : body.radius;
    const fill = robot ? this.robot(index) : body.kind === "turtle" ? this.look.turtles[index % this.look.turtles.length]
      : this.look[body.kind] || this.look.solid;
    if (radius) this.disc(x, y, radius, fill, robot ? this.look.floor : this.look.edge);
    else this.area(body.outline.map(([u, v]) => placed(u, v)), fill, robot ? this.look.floor : this.look.wall);
    if (robot) {
      const r = radius || Math.max(...body.outline.map(([u, v]) => Math.hypot(u, v))) / 2;
      this.context.beginPath();
      for (const [u, v] of [[0.8, 0], [-0.4, 0.55], [-0.15, 0], [-0.4, -0.55]]) {
        this.context.lineTo(...this.at(...placed(r * u, r * v)));
      }
      this.context.fillStyle = this.look.nose;
      this.context.fill();
    }
    if (body.kind === "link") this.disc(x, y, 3 / this.scale, this.look.nose, this.look.wall);
  }

  contacts() {
    for (const [x, y] of this.frame.contacts) {
      const [px, py] = this.at(x, y);
      const c = this.context;
      c.beginPath();
      c.moveTo(px - 5, py - 5);
      c.lineTo(px + 5, py + 5);
      c.moveTo(px - 5, py + 5);
      c.lineTo(px + 5, py - 5);
      c.strokeStyle = this.look.floor;
      c.lineWidth = 5;
      c.stroke();
      c.strokeStyle = this.look.contact;
      c.lineWidth = 2.5;
      c.stroke();
    }
  }

  /** The scale: the length of a grid cell. */
  ruler() {
    const c = this.context;
    const [x, y] = this.at(this.world.bounds[0], this.world.bounds[1]);
    const left = Math.max(x, 0) + 10, low = Math.min(y, this.height) - 10, right = left + this.unit * this.scale;
    c.beginPath();
    c.moveTo(left, low - 4);
    c.lineTo(left, low);
    c.lineTo(right, low);
    c.lineTo(right, low - 4);
    c.font = "11px system-ui, sans-serif";
    c.textAlign = "center";
    for (const { color, width } of [{ color: this.look.floor, width: 4 }, { color: this.look.ink, width: 1.5 }]) {
      c.strokeStyle = c.fillStyle = color;
      c.lineWidth = width;
      c.stroke();
      if (width > 2) c.strokeText(`${this.unit} m`, (left + right) / 2, low - 4);
      else c.fillText(`${this.unit} m`, (left + right) / 2, low - 4);
    }
  }
}
