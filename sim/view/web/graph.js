// The graph of a run in a collapsible part of the page: nodes, their connections, and missing connections.

const LINE = 15.7, HEAD = [8, 3.2]; // CSS pixels: height of a line; length and half width of an arrow's head

/** Creates an SVG element with attributes, and children: elements or text. */
function makeSvg(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

class Graph {
  /** `onOpen` is called when a user expands it. */
  constructor(onOpen = () => {}) {
    this.place = make("div", { className: "wires", tabIndex: 0, role: "group", "aria-label": "Graph" });
    this.reasons = make("ol");
    this.more = make("div", { className: "rate" });
    this.summary = make("summary", { className: "head" });
    this.root = make("details", { className: "graph", hidden: true }, this.summary, this.place, this.reasons, this.more);
    this.root.addEventListener("toggle", () => { if (this.root.open) { this.tint(); onOpen(); } });
    this.root.addEventListener("toggle", () => onTheme(this.root, () => this.tint()), { once: true });
    this.rates = new Map(); // topic name -> text element of its rate
    this.topics = new Map(); // topic name -> its box
    this.head();
  }

  /** Whether it is visible to a user. */
  get visible() {
    return this.root.open && this.root.clientWidth > 0 && !document.hidden;
  }

  /** Set the colors of a light or dark page. */
  tint() {
    const { contact, floor } = colors(this.root);
    this.root.style.setProperty("--gap", contact);
    this.root.style.setProperty("--floor", floor);
  }

  head(gaps = 0) {
    const count = gaps ? `: ${gaps} MISSING CONNECTION${gaps > 1 ? "S" : ""}` : "";
    this.summary.textContent = `GRAPH${count || ": WHO SENDS WHAT TO WHOM"}`;
  }

  /** Show the data of ../graph_data.py. */
  show(data) {
    const { width, height, boxes, arrows, reasons, more, words } = checkGraph(data);
    this.root.hidden = false;
    this.rates.clear();
    this.topics.clear();
    const look = `width:100%;min-width:${Math.round(Math.min(width, Math.max(300, 0.75 * width)))}px;max-width:${width}px`;
    this.place.replaceChildren(makeSvg("svg", {
      viewBox: `0 0 ${width} ${height}`, style: look, role: "img", "aria-label": words,
    }, ...arrows.map((arrow) => this.arrow(arrow)), ...boxes.map((box) => this.box(box)),
    ...arrows.filter(({ gap }) => gap).map((arrow) => this.number(arrow))));
    this.reasons.replaceChildren(...reasons.map((reason) => make("li", {}, reason)));
    this.more.textContent = more;
    this.head(reasons.length);
  }

  arrow({ points, gap, rest }) {
    const [x, y] = points.slice(-2), [fromX, fromY] = points.slice(-4);
    const length = Math.hypot(x - fromX, y - fromY) || 1;
    const [u, v] = [(x - fromX) / length, (y - fromY) / length], [long, wide] = HEAD;
    const corner = (side) => `${x - u * long - side * v * wide} ${y - v * long + side * u * wide}`;
    const line = makeSvg("path", { class: "line", d: `M ${points.slice(0, 2).join(" ")} C ${points.slice(2).join(" ")}` });
    const tip = makeSvg("path", { class: "tip", d: `M ${x} ${y} L ${corner(1)} L ${corner(-1)} Z` });
    return makeSvg("g", { class: gap ? "gap" : rest ? "rest" : "wire" }, line, ...(rest ? [] : [tip]));
  }

  number({ gap, middle: [x, y] }) {
    return makeSvg("g", { class: "gap" }, makeSvg("circle", { cx: x, cy: y, r: 8 }),
      makeSvg("text", { x, y: y + 3.6 }, String(gap)));
  }

  box({ kind, name, lines, place: [x, y, width, height] }) {
    const round = { node: height / 2, course: height / 2, action: 6 }[kind] ?? 0;
    const middle = x + width / 2, first = y + height / 2 - LINE * (lines.length - 1) / 2 + 4;
    const rows = lines.map((line, index) => makeSvg("text", { x: middle, y: first + index * LINE, class: index ? "much" : "" }, line));
    if (kind === "topic" && !lines[1]) this.rates.set(name, rows[1]);
    const element = makeSvg("g", { class: kind }, makeSvg("rect", { x, y, width, height, rx: round }), ...rows);
    if (kind === "topic") this.topics.set(name, element);
    return element;
  }

  /** Mark the box of a topic that has messages at the cursor. */
  setActive(name, active) {
    this.topics.get(name)?.classList.toggle("now", active);
  }

  /** Write the rate of a topic into its box. */
  setRate(name, rate) {
    const line = this.rates.get(name);
    if (line) line.textContent = rate;
  }
}
