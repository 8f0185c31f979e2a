// The details of the selected topic: its type, its message at the cursor or the newest one, and a small plot of its numbers.

const PLOT_EDGE = 4; // px around a plot
const DASHES = [[], [5, 3]]; // curves differ in more than color

class Topic {
  /** @param {(time: number) => void} [seek] called with the time (s) at which a plot over time is clicked */
  constructor(seek) {
    this.title = make("b");
    this.type = make("span", { className: "rate" });
    this.canvas = make("canvas", { role: "img" });
    this.caption = make("div", { className: "rate" });
    this.image = make("img", { alt: "" });
    this.message = make("pre", { tabIndex: 0, "aria-label": "Newest message" });
    this.range = [0, 1]; // of the plot's horizontal axis
    if (seek) this.canvas.addEventListener("click", ({ offsetX }) => seek(this.timeAt(offsetX)));
    this.root = make("div", { className: "looked", hidden: true },
      make("div", {}, this.title, " ", this.type), this.image, this.canvas, this.caption, this.message);
  }

  /** Show the data of ../../ros/play/telemetry.py; null hides it. */
  show(topic) {
    this.root.hidden = !topic;
    if (!topic) return;
    this.title.textContent = text(topic.name);
    this.type.textContent = text(topic.type);
    const when = topic.stamp === null ? "" : `# at ${number(topic.stamp).toFixed(2)} s\n`;
    this.message.textContent = when + text(topic.text, 20000);
    this.showImage(topic.image ? DATA.image(topic.image) : null);
    const curves = list(topic.curves, 2, (curve) => ({
      name: text(curve.name), along: text(curve.along), points: list(curve.points, 1000, numbers(2)),
    })).filter(({ points }) => points.length > 1);
    this.canvas.hidden = this.caption.hidden = !curves.length;
    if (curves.length) this.plot(curves, topic.cursor, topic.end);
  }

  /** The time (s) at a horizontal position (px) in the plot. */
  timeAt(px) {
    const [left, right] = this.range, width = this.canvas.clientWidth;
    return left + (right - left) * Math.min(Math.max((px - PLOT_EDGE) / (width - 2 * PLOT_EDGE), 0), 1);
  }

  /** Show what a camera sees. */
  showImage(image) {
    this.image.hidden = !image;
    if (!image) return;
    const source = webpAddress(image);
    if (this.image.src !== source) this.image.src = source;
    this.image.alt = `An image of ${image.width} by ${image.height} pixels`;
  }

  /** Plot curves. Of a replay, `cursor` is the time to mark, and the plot goes from 0 to `end` (s), as its scrub bar. */
  plot(curves, cursor, end) {
    const points = curves.flatMap((curve) => curve.points);
    const ends = (axis) => [Math.min(...points.map((p) => p[axis])), Math.max(...points.map((p) => p[axis]))];
    const [left, right] = end === undefined ? ends(0) : [0, end], [low, high] = ends(1);
    this.range = [left, right];
    const range = `${low.toPrecision(3)} to ${high.toPrecision(3)}`;
    const names = curves.map(({ name }, i) => `${i ? "- -" : "—"} ${name}`).join("   ");
    const unit = curves[0].along === "s" ? `over ${(right - left).toPrecision(2)} s` : `items ${left} to ${right}`;
    this.caption.textContent = `${names}   ${range}, ${unit}`;
    this.canvas.setAttribute("aria-label", `Plot of ${this.caption.textContent}`);
    const sharp = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth, height = 70, edge = PLOT_EDGE;
    this.canvas.width = Math.round(width * sharp);
    this.canvas.height = Math.round(height * sharp);
    const c = this.canvas.getContext("2d");
    const look = colors(this.canvas);
    c.scale(sharp, sharp);
    if (cursor !== undefined) {
      const at = edge + (width - 2 * edge) * Math.min(Math.max((cursor - left) / (right - left || 1), 0), 1);
      c.fillStyle = look.hit;
      c.fillRect(at - 1, 0, 2, height);
    }
    curves.forEach((curve, i) => {
      c.beginPath();
      for (const [x, y] of curve.points) {
        c.lineTo(edge + (width - 2 * edge) * (x - left) / (right - left || 1),
          height - edge - (height - 2 * edge) * (high > low ? (y - low) / (high - low) : 0.5));
      }
      c.setLineDash(DASHES[i]);
      c.strokeStyle = look.robots[i];
      c.lineWidth = 1.5;
      c.stroke();
    });
  }
}
