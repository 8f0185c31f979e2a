// What part of a world a WorldCanvas shows: zoom, pan and follow, by buttons, keys, pointer and wheel.

const MOST_ZOOM = 16, ZOOM_STEP = 1.5;
const PAN_STEP = 0.15; // of the width, for a key
const PANS = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };

/**
 * The center (m) and scale (px/m) that a view of a world of this size has at a zoom, without showing more than all.
 * @param {{ width: number, height: number }} size @param {number[]} shown left, bottom, right and top (m)
 * @param {number} zoom @param {number[]} center
 */
function viewAt(size, shown, zoom, center) {
  const [left, bottom, right, top] = shown;
  const scale = zoom * Math.min(size.width / (right - left), size.height / (top - bottom));
  const inside = (value, low, high, pixels) => {
    const half = pixels / scale / 2;
    return high - low <= 2 * half ? (low + high) / 2 : Math.min(Math.max(value, low + half), high - half);
  };
  return { scale, x: inside(center[0], left, right, size.width), y: inside(center[1], bottom, top, size.height) };
}

/** The controls of a WorldCanvas; `follows` is the index of the body that can be followed, or -1. */
class Camera {
  /** @param {WorldCanvas} picture @param {number} follows */
  constructor(picture, follows) {
    this.picture = picture;
    this.follows = follows;
    this.zoom = 1;
    /** @type {number[] | null} */
    this.center = null; // m; null is the middle
    this.following = false;
    this.toggle = button("follow", "Follow the robot (F)", () => this.follow(!this.following));
    this.toggle.setAttribute("aria-pressed", "false");
    this.less = button("less", "Zoom out (−)", () => this.zoomBy(1 / ZOOM_STEP));
    this.whole = button("whole", "Show everything (0)", () => this.reset());
    this.root = make("div", { className: "group zoom", role: "group", "aria-label": "View" },
      button("more", "Zoom in (+)", () => this.zoomBy(ZOOM_STEP)), this.less, this.whole, ...(follows < 0 ? [] : [this.toggle]));
    const { canvas } = picture;
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.grab(event));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { this.last = null; });
    this.update();
  }

  /** The view to draw with: scale, and the center in meters. */
  view() {
    const { picture } = this, [left, bottom, right, top] = picture.shown;
    const pose = this.following ? picture.frame.poses[this.follows] : null;
    return viewAt(picture, picture.shown, this.zoom, pose ?? this.center ?? [(left + right) / 2, (bottom + top) / 2]);
  }

  /** Zoom by a factor; a point of the picture (px), if given, stays where it is. */
  zoomBy(factor, px = this.picture.width / 2, py = this.picture.height / 2) {
    const { picture } = this, before = this.view();
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), MOST_ZOOM);
    const dx = px - picture.width / 2, dy = picture.height / 2 - py;
    const after = viewAt(picture, picture.shown, this.zoom, [before.x, before.y]).scale;
    this.center = [before.x + dx / before.scale - dx / after, before.y + dy / before.scale - dy / after];
    this.update();
  }

  panBy(dx, dy) {
    const { x, y, scale } = this.view();
    this.following = false;
    this.center = [x + dx / scale, y + dy / scale];
    this.update();
  }

  follow(following) {
    this.following = following;
    if (following && this.zoom === 1) this.zoom = 2 * ZOOM_STEP;
    this.update();
  }

  reset() {
    Object.assign(this, { zoom: 1, center: null, following: false });
    this.update();
  }

  update() {
    const { x, y } = this.view();
    if (this.center) this.center = [x, y];
    this.toggle.setAttribute("aria-pressed", String(this.following));
    this.less.disabled = this.whole.disabled = this.zoom === 1 && !this.following;
    this.picture.canvas.style.cursor = this.zoom > 1 ? "grab" : "";
    this.picture.requestPaint();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const acts = {
      "+": () => this.zoomBy(ZOOM_STEP), "=": () => this.zoomBy(ZOOM_STEP), "-": () => this.zoomBy(1 / ZOOM_STEP), 0: () => this.reset(),
      f: () => this.follows >= 0 && this.follow(!this.following),
    };
    const pan = event.shiftKey && PANS[event.code];
    const act = pan ? () => this.panBy(pan[0] * PAN_STEP * this.picture.width, pan[1] * PAN_STEP * this.picture.width) : acts[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  }

  /** Pinching, or the wheel with Ctrl; without it, the page scrolls. */
  wheel(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    this.zoomBy(Math.exp(-event.deltaY / 200), event.offsetX, event.offsetY);
  }

  grab(event) {
    if (event.button !== 0 || this.zoom === 1) return;
    this.last = [event.clientX, event.clientY];
    this.picture.canvas.setPointerCapture(event.pointerId);
  }

  drag(event) {
    if (!this.last) return;
    const [x, y] = this.last;
    this.last = [event.clientX, event.clientY];
    this.panBy(x - event.clientX, event.clientY - y);
  }
}
