// Pen strokes of ../strokes.py: the visible ones for the live view, and all with times for the replay.

const MOST_STROKES = 1000, MOST_POINTS = 20000;

const colorOf = (value) => {
  if (!Number.isInteger(value) || value < 0 || value > 0xffffff) refuse("a color");
  return `#${value.toString(16).padStart(6, "0")}`;
};

/** Parses the visible strokes: the ground's color, and strokes with color, width (m) and points. */
function checkDrawn({ ground, strokes }) {
  return {
    ground: colorOf(ground),
    strokes: list(strokes, MOST_STROKES, ([color, width, points]) => ({
      color: colorOf(color), width: size(width), points: list(points, MOST_POINTS, numbers(2)),
    })),
  };
}

/** Parses all strokes; `visibleAt` selects those visible at a time (s). */
function checkDrawing({ grounds, strokes }) {
  return {
    grounds: list(grounds, MOST_STROKES, ([stamp, color]) => ({ stamp: number(stamp, 1e9) * 1e-3, color: colorOf(color) })),
    strokes: list(strokes, MOST_STROKES, ([color, width, erased, points]) => ({
      color: colorOf(color), width: size(width), erased: erased === null ? Infinity : number(erased, 1e9) * 1e-3,
      points: list(points, MOST_POINTS, (point) => {
        if (!Array.isArray(point) || point.length !== 3) refuse("3 numbers");
        return [number(point[0], 1e9) * 1e-3, number(point[1]), number(point[2])];
      }),
    })),
  };
}

function visibleAt({ grounds, strokes }, time) {
  const ground = grounds[Math.max(before(grounds, time, stampOf), 0)];
  const visible = strokes.filter(({ erased, points }) => points.length && points[0][0] <= time + 1e-6 && time < erased);
  return {
    ground: ground?.color,
    strokes: visible.map(({ color, width, points }) => ({
      color, width, points: points.slice(0, before(points, time, ([stamp]) => stamp) + 1).map(([, x, y]) => [x, y]),
    })),
  };
}
