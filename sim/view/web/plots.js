// Turns every inert div with a plot over time (../plot_data.py) into an interactive one, drawn by uPlot. The data is
// untrusted: it is validated, and on any error the div keeps its PNG. The time cursor is that of all pictures of the run.

const PANEL = 170, ROW = 26, AXIS = 44, ROW_NAMES = 190; // CSS pixels: heights of a panel, a row and the axis of time; width of names
const DASHES = [[], [6, 3], [2, 3], [8, 3, 2, 3]]; // curves differ in more than color
const DENSE = 3, FAINT = 0.4; // pixels between two ticks below which they are paler; the palest
const NEAR = 0.015; // share of the visible time within which a mark is named
const KEY_STEP = 0.01; // share of the visible time that an arrow key moves the cursor by
const STYLES = ["line", "step", "points"], COLORS = ["warning", "caution", "muted"];
const MARK_KINDS = ["contact", "error", "missed", "push", "end"];
const FONT = "12px system-ui, sans-serif";

/** Parses the data of ../plot_data.py; throws a TypeError if it is invalid. */
function checkPlot(plot) {
  if (plot.version !== 1) refuse("version 1");
  const color = (value) => (COLORS.includes(value) ? value : size(value));
  const series = ({ name, style, color: tint, markers, x, y }) => {
    const moments = list(x, 5000, (stamp) => number(stamp));
    const values = list(y, 5000, (value) => (value === null ? null : number(value, 1e12)));
    if (moments.length !== values.length) refuse("a value for each stamp");
    return { name: text(name), style: STYLES.includes(style) ? style : refuse("a style"), color: color(tint), markers: Boolean(markers), x: moments, y: values };
  };
  return {
    key: /^[0-9a-f]{12}$/.test(plot.run) ? plot.run : "", title: text(plot.title), failure: text(plot.failure), begin: size(plot.begin), end: size(plot.end),
    panels: list(plot.panels, 20, (panel) => ({
      unit: text(panel.unit), series: list(panel.series, 20, series),
      levels: list(panel.levels, 5, ([value, name, tint]) => ({ value: number(value), name: text(name), color: color(tint) })),
    })),
    rows: list(plot.rows, 200, ({ name, color: tint, x }) => ({
      name: text(name), color: color(tint), x: list(x, 5000, (stamp) => number(stamp)),
    })),
    marks: list(plot.marks, 1000, ([stamp, kind, words]) => ({
      stamp: number(stamp, 1e9) * 1e-3, kind: MARK_KINDS.includes(kind) ? kind : refuse("a kind of mark"), words: text(words),
    })),
  };
}

/** The columns of uPlot: all stamps of the series in order, and for each series its values; undefined where it has none. */
function aligned(series) {
  const stamps = [...new Set(series.flatMap(({ x }) => x))].sort((a, b) => a - b);
  const index = new Map(stamps.map((stamp, at) => [stamp, at]));
  return [stamps, ...series.map(({ x, y }) => {
    const column = Array(stamps.length).fill(undefined);
    x.forEach((stamp, at) => { column[index.get(stamp)] = y[at]; });
    return column;
  })];
}

class TimePlot {
  constructor(plot) {
    this.plot = plot;
    this.root = make("div", { className: "ros2-view ros2-time-plot", tabIndex: 0, role: "group" });
    this.root.dataset.lmSuppressShortcuts = "true";
    this.place = make("div", { className: "panels" });
    this.statusLine = make("div", { className: "say", role: "status" });
    const help = "Point at it to see values. Drag to zoom, double-click to zoom out; arrow keys move the cursor.";
    this.root.append(make("style", {}, `${UPLOT_STYLE}\n${STYLE}`), make("div", { className: "title", title: help }, plot.title), this.place, this.statusLine);
    this.failure = make("div", { className: "failure" }, plot.failure);
    if (plot.failure) this.root.append(this.failure);
    this.root.setAttribute("aria-label", `Plot ${plot.title}. ${help}`);
    this.root.addEventListener("keydown", (event) => this.onKey(event));
    this.range = { min: plot.begin, max: plot.end };
    this.time = null;
  }

  /** Draw, after the root has been added to the page and has a size. */
  start() {
    this.draw();
    onTheme(this.root, () => this.draw());
    new ResizeObserver(() => this.fit()).observe(this.root);
    followCursor(this.root, this.plot.key, (time) => this.setTime(time, false));
    followTimeLinks();
  }

  get width() {
    return Math.max(this.root.clientWidth - 16, 200);
  }

  fit() {
    if (this.width === this.drawn) return;
    this.drawn = this.width;
    for (const chart of this.charts) chart.setSize({ width: this.width, height: chart.height });
  }

  draw() {
    const look = colors(this.root);
    if (look === this.look) return;
    this.look = look;
    this.failure.style.color = look.failure;
    this.drawn = this.width;
    for (const chart of this.charts ?? []) chart.destroy();
    const { panels: all, rows } = this.plot;
    const panels = rows.length ? [this.rowsChart()] : all.map((panel, index) => this.panelChart(panel, index === all.length - 1));
    this.charts = panels;
  }

  color(value, index) {
    if (value === "warning") return this.look.contact;
    if (value === "caution") return this.look.rim;
    if (value === "muted") return this.look.edge;
    return this.look.robots[(value + index) % this.look.robots.length];
  }

  /** The options that all charts share; `last` has the axis of time. */
  options(height, last, more) {
    const { look } = this;
    const axis = { stroke: look.ink, font: FONT, grid: { stroke: look.grid, width: 1 }, ticks: { stroke: look.grid, width: 1 } };
    return {
      width: this.width, height: height + (last ? AXIS : 8), padding: [8, 12, 0, 0],
      cursor: {
        drag: { x: true, y: false }, focus: { prox: 20 }, points: { size: 7 },
        bind: { dblclick: () => () => this.zoom({ min: this.plot.begin, max: this.plot.end }) },
      },
      select: { show: true },
      scales: { x: { time: false, min: this.range.min, max: this.range.max }, ...more.scales },
      axes: [{ ...axis, show: last, label: last ? "time (s)" : undefined, labelFont: FONT, labelSize: 20, labelGap: 4, size: 26 }, { ...axis, ...more.axis }],
      series: [{ label: "time", value: (_, time) => (time === null ? "-" : `${time.toFixed(2)} s`) }, ...more.series],
      legend: { show: more.legend !== false },
      hooks: {
        ready: [({ over }) => over.addEventListener("pointermove", (event) => this.onPointer(over, event))],
        setScale: [(chart, scale) => { if (scale === "x") this.onScale(chart); }],
        draw: [(chart) => this.drawMarks(chart), ...(more.after ?? [])],
      },
    };
  }

  panelChart({ unit, series, levels }, last) {
    const values = [...series.flatMap(({ y }) => y.filter((value) => value !== null)), ...levels.map(({ value }) => value)];
    const low = Math.min(...values), high = Math.max(...values), room = (high - low || 1) * 0.06;
    const look = series.map(({ name, style, color, markers }, index) => {
      const stroke = this.color(color, typeof color === "number" ? index : 0);
      return {
        label: name, stroke, width: style === "points" ? 0 : 1.6, dash: DASHES[index % DASHES.length],
        points: { show: markers, size: style === "points" ? 4 : 6, fill: style === "points" ? stroke : undefined },
        paths: style === "points" ? () => null : style === "step" ? uPlot.paths.stepped({ align: 1 }) : uPlot.paths.linear(),
        value: (_, value) => (value === null || value === undefined ? "-" : `${rounded(value, high - low)}${unit ? ` ${unit}` : ""}`),
      };
    });
    const lines = (chart) => levels.forEach(({ value, name, color }) => this.level(chart, value, name, this.color(color, 0)));
    const more = {
      series: look, after: [lines], axis: { label: unit || undefined, labelFont: FONT, labelSize: 18, size: 56 },
      scales: { y: { range: values.length ? [low - room, high + room] : [0, 1] } },
    };
    return new uPlot(this.options(PANEL, last, more), aligned(series), this.place);
  }

  level(chart, value, name, stroke) {
    const c = chart.ctx, y = chart.valToPos(value, "y", true), { left, width } = chart.bbox;
    c.save();
    c.strokeStyle = c.fillStyle = stroke;
    c.setLineDash([6, 4]);
    c.beginPath();
    c.moveTo(left, y);
    c.lineTo(left + width, y);
    c.stroke();
    c.font = `${11 * uPlot.pxRatio}px system-ui, sans-serif`;
    c.textAlign = "right";
    c.fillText(name, left + width - 4, y - 3);
    c.restore();
  }

  rowsChart() {
    const { rows } = this.plot;
    const series = rows.map(({ name, x }) => ({ name, x, y: x.map(() => 0) }));
    const ticks = (chart) => rows.forEach(({ x, color }, index) => {
      const c = chart.ctx, y = chart.valToPos(index, "y", true), half = 8 * uPlot.pxRatio, { left, width } = chart.bbox;
      c.save();
      c.beginPath();
      const shown = x.map((stamp) => chart.valToPos(stamp, "x", true)).filter((at) => at >= left && at <= left + width);
      for (const at of shown) {
        c.moveTo(at, y - half);
        c.lineTo(at, y + half);
      }
      c.globalAlpha = Math.min(Math.max(width / DENSE / uPlot.pxRatio / shown.length, FAINT), 1); // where ticks touch, a gap still shows
      c.strokeStyle = this.color(color, 0);
      c.lineWidth = 1.5 * uPlot.pxRatio;
      c.stroke();
      c.restore();
    });
    const more = {
      legend: false, after: [ticks], scales: { y: { range: [-0.5, rows.length - 0.5], dir: -1 } },
      series: series.map(({ name }) => ({ label: name, paths: () => null, points: { show: false } })),
      axis: { size: () => Math.min(ROW_NAMES, this.width * 0.4), splits: () => rows.map((_, index) => index), values: () => rows.map(({ name }) => name.replace("\n", ": ")) },
    };
    return new uPlot(this.options(ROW * rows.length, true, more), aligned(series), this.place);
  }

  drawMarks(chart) {
    const c = chart.ctx, { left, top, width, height } = chart.bbox;
    for (const { stamp, kind } of this.plot.marks) {
      const x = chart.valToPos(stamp, "x", true);
      if (kind === "end" || x < left || x > left + width) continue;
      c.save();
      c.strokeStyle = c.fillStyle = kind === "push" ? this.look.rim : this.look.contact;
      c.lineWidth = uPlot.pxRatio;
      c.beginPath();
      c.moveTo(x, top);
      c.lineTo(x, top + height);
      c.stroke();
      c.beginPath();
      for (const [u, v] of [[-5, 0], [5, 0], [0, 7]]) c.lineTo(x + u * uPlot.pxRatio, top + v * uPlot.pxRatio);
      c.fill();
      c.restore();
    }
  }

  onPointer(over, { offsetX }) {
    const chart = this.charts.find((each) => each.over === over);
    this.setTime(chart.posToVal(offsetX, "x"), true, chart);
  }

  /** A part of one panel was selected: all show it. */
  onScale(chart) {
    const { min, max } = chart.scales.x;
    if (min === null || !this.charts?.includes(chart)) return;
    if (min !== this.range.min || max !== this.range.max) this.zoom({ min, max });
  }

  zoom(range) {
    this.range = range;
    for (const chart of this.charts) chart.setScale("x", range);
    if (this.time !== null) this.setTime(this.time, false);
  }

  /** Move the cursor of all panels; `announce` moves that of the run's other pictures, too. */
  setTime(time, announce, from) {
    this.time = Math.min(Math.max(time, this.plot.begin), this.plot.end);
    for (const chart of this.charts) {
      if (chart !== from) chart.setCursor({ left: chart.valToPos(this.time, "x"), top: chart.bbox.height / 2 / uPlot.pxRatio }, false);
    }
    this.showStatus();
    if (announce) moveCursor(this.plot.key, this.time, this.root);
  }

  /** The time, and what happened near it. */
  showStatus() {
    const reach = NEAR * (this.range.max - this.range.min);
    const time = this.time.toFixed(2), marks = this.plot.marks.filter(({ stamp }) => Math.abs(stamp - this.time) <= reach);
    const [now, near] = [true, false].map((here) => marks.filter(({ stamp }) => (stamp.toFixed(2) === time) === here).map(({ words }) => words));
    const happens = now.map((words) => words.replace(/^t = [^:]*: /, "")).join("; ");
    const counts = this.plot.rows.map(({ x }) => x.filter((stamp) => stamp <= this.time).length);
    const rows = this.plot.rows.length === 1 ? `; ${counts[0]} so far` : "";
    const words = `t = ${time} s${rows}${happens && `: ${happens}`}${near.length ? `. ${near.join("; ")}` : ""}`;
    if (this.statusLine.textContent !== words) this.statusLine.textContent = words;
  }

  onKey(event) {
    const direction = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!direction || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    this.setTime((this.time ?? this.range.min) + direction * KEY_STEP * (this.range.max - this.range.min), true);
  }
}

async function installPlot(div) {
  div.dataset.wired = "true";
  const picture = [...div.childNodes];
  try {
    const plot = new TimePlot(checkPlot(await unpack(div.dataset.plot || "")));
    div.replaceChildren(plot.root);
    plot.start();
  } catch (error) {
    div.replaceChildren(...picture);
    console.warn(`This plot stays a picture: ${error.message}`);
  }
}

/** Wire all plots of the page; outputs without this script call it. */
window.ros2CoursePlots = () => document.querySelectorAll("div.ros2-plot:not([data-wired])").forEach(installPlot);
window.ros2CoursePlots();
