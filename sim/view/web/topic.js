// The details of the selected topic: its type, its message at the cursor or the newest one, and a small plot of its numbers.

const DASHES = [[], [5, 3]]; // curves differ in more than color

class Topic {
  constructor() {
    this.title = make("b");
    this.type = make("span", { className: "rate" });
    this.canvas = make("canvas", { role: "img" });
    this.caption = make("div", { className: "rate" });
    this.message = make("pre", { tabIndex: 0, "aria-label": "Newest message" });
    this.root = make("div", { className: "looked", hidden: true },
      make("div", {}, this.title, " ", this.type), this.canvas, this.caption, this.message);
  }

  /** Show the data of ../../ros/play/telemetry.py; null hides it. */
  show(topic) {
    this.root.hidden = !topic;
    if (!topic) return;
    this.title.textContent = text(topic.name);
    this.type.textContent = text(topic.type);
    const when = topic.stamp === null ? "" : `# at ${number(topic.stamp).toFixed(2)} s\n`;
    this.message.textContent = when + text(topic.text, 20000);
    const curves = list(topic.curves, 2, (curve) => ({
      name: text(curve.name), along: text(curve.along), points: list(curve.points, 1000, numbers(2)),
    })).filter(({ points }) => points.length > 1);
    this.canvas.hidden = this.caption.hidden = !curves.length;
    if (curves.length) this.plot(curves, topic.cursor);
  }

  /** Plot curves; `cursor`, if given, is the time (s) to mark. */
  plot(curves, cursor) {
    const points = curves.flatMap((curve) => curve.points);
    const ends = (axis) => [Math.min(...points.map((p) => p[axis])), Math.max(...points.map((p) => p[axis]))];
    const [left, right] = ends(0), [low, high] = ends(1);
    const range = `${low.toPrecision(3)} to ${high.toPrecision(3)}`;
    const names = curves.map(({ name }, i) => `${i ? "- -" : "—"} ${name}`).join("   ");
    const unit = curves[0].along === "s" ? `over ${(right - left).toPrecision(2)} s` : `items ${left} to ${right}`;
    this.caption.textContent = `${names}   ${range}, ${unit}`;
    this.canvas.setAttribute("aria-label", `Plot of ${this.caption.textContent}`);
    const sharp = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth, height = 70, edge = 4;
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
