// Draws layers into the picture of a world.

const SIGMAS = 2; // of an ellipse: 86 % of a Gaussian's positions are inside
const AXIS = 24, ARROW = 17; // px
const INSET = 0.34, WIDEST = 180; // an image's share of the picture's width, and px at most

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
  for (const { kind, data } of layers) {
    if (kind === "plan" && data.length) picture.line(data, picture.look.plan, 4);
    if (kind === "points") data.places.forEach((place) => paintDot(picture, place, marksOf(picture.look)[data.color]));
    if (kind === "goal") fillShape(picture, data, [[0, 15], [2.6, 10], [Math.PI, 4], [-2.6, 10]], picture.look.aim);
  }
}

function paintDot(picture, [x, y], color) {
  const [px, py] = picture.at(x, y);
  picture.context.fillStyle = color;
  picture.context.fillRect(px - 1.5, py - 1.5, 3, 3);
}

/** Fill a shape at a pose, of corners with an angle and a distance (px). */
function fillShape(picture, [x, y, yaw], corners, color) {
  const c = picture.context, [px, py] = picture.at(x, y);
  c.beginPath();
  for (const [angle, reach] of corners) c.lineTo(px + reach * Math.cos(yaw + angle), py - reach * Math.sin(yaw + angle));
  c.closePath();
  c.fillStyle = color;
  c.fill();
}

/** Draw what is seen and believed over all else. @param {WorldCanvas} picture @param {Layer[]} layers */
function paintBeliefs(picture, layers) {
  const taken = [];
  const each = (wanted, paint) => layers.filter(({ kind }) => kind === wanted).forEach(paint);
  each("cloud", ({ data }) => data.forEach((pose) => fillShape(picture, pose, [[0, 6], [2.5, 3], [-2.5, 3]], picture.look.belief)));
  each("pose", ({ data }) => paintPose(picture, data));
  each("frames", (layer) => paintAxes(picture, layer, taken));
  layers.filter(({ kind }) => kind === "image").reduce((top, layer) => paintImage(picture, layer, top), 6);
}

/** The half axes of the ellipse of a covariance, and the direction of the first (rad). */
function ellipseOf(xx, xy, yy) {
  const middle = (xx + yy) / 2, reach = Math.hypot((xx - yy) / 2, xy);
  return [Math.sqrt(middle + reach), Math.sqrt(Math.max(middle - reach, 0)), Math.atan2(2 * xy, xx - yy) / 2];
}

/** A believed pose: its ellipse, and an arrow. */
function paintPose(picture, [x, y, yaw, xx, xy, yy]) {
  const c = picture.context, { look, scale } = picture, [px, py] = picture.at(x, y);
  const [long, short, turn] = ellipseOf(xx, xy, yy);
  c.beginPath();
  c.ellipse(px, py, SIGMAS * long * scale, SIGMAS * short * scale, -turn, 0, 7);
  c.fillStyle = look.doubt;
  c.fill();
  c.strokeStyle = look.belief;
  c.lineWidth = 1.5;
  c.stroke();
  c.beginPath();
  c.moveTo(px, py);
  c.lineTo(px + ARROW * Math.cos(yaw), py - ARROW * Math.sin(yaw));
  c.lineWidth = 2.5;
  c.stroke();
  const ahead = ARROW / scale;
  fillShape(picture, [x + ahead * Math.cos(yaw), y + ahead * Math.sin(yaw), yaw], [[0, 6], [2.4, 7], [-2.4, 7]], look.belief);
}

/** The axes of a frame, x, y and z as in RViz, and its name where there is room. */
function paintAxes(picture, { data, name }, taken) {
  const c = picture.context, [px, py] = picture.at(data[0], data[1]);
  axesOf(data.slice(2)).forEach(([right, up], axis) => {
    c.beginPath();
    c.moveTo(px, py);
    c.lineTo(px + AXIS * right, py - AXIS * up);
    c.strokeStyle = picture.look.axes[axis];
    c.lineWidth = 2.5;
    c.stroke();
  });
  picture.label(name, px, py, taken);
}

/** The directions of the x, y and z axes of a rotation, seen from above; a quaternion needn't have length 1. */
function axesOf([x, y, z, w]) {
  const norm = x * x + y * y + z * z + w * w || 1;
  return [
    [(w * w + x * x - y * y - z * z) / norm, 2 * (x * y + w * z) / norm],
    [2 * (x * y - w * z) / norm, (w * w - x * x + y * y - z * z) / norm],
    [2 * (x * z + w * y) / norm, 2 * (y * z - w * x) / norm],
  ];
}

/** A camera's image in the corner; returns where the next one may begin (px). */
function paintImage(picture, layer, top) {
  const c = picture.context, { width, height } = layer.data;
  if (!layer.image) {
    layer.image = make("img", { src: webpAddress(layer.data) });
    layer.image.addEventListener("load", () => picture.requestPaint());
  }
  if (layer.image.complete && layer.image.naturalWidth) picture.images.set(layer.topic, layer.image);
  const wide = Math.min(INSET * picture.width, WIDEST), high = wide * height / (width || 1);
  c.fillStyle = picture.look.floor;
  c.fillRect(6, top, wide, high);
  c.imageSmoothingEnabled = false;
  const image = picture.images.get(layer.topic); // until the new one has loaded, the last one
  if (image) c.drawImage(image, 6, top, wide, high);
  c.strokeStyle = picture.look.wall;
  c.lineWidth = 1.5;
  c.strokeRect(6, top, wide, high);
  return top + high + 6;
}
