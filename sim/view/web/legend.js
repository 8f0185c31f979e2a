// What the signs in the picture of a world mean, and the world's name.

const SIGNS = { box: ["■", "box"], person: ["●", "person"], ghost: ["●", "ghost"] };

/**
 * Sign, color and meaning of what a world has besides walls and one robot; `look` is a palette.
 * @param {World} world @param {Record<string, any>} look
 */
function legendOf(world, look) {
  const kinds = new Set(world.bodies.map(({ kind }) => kind));
  const robots = world.bodies.filter(({ kind }) => kind === "robot");
  const entries = robots.length > 1 ? robots.map(({ name }, index) => ["●", look.robots[index % look.robots.length], name]) : [];
  if (world.goal) entries.push(["★", look.goal, "goal"]);
  if (robots.length && world.boxes.length + world.circles.length) entries.push(["■", look.edge, "obstacle"]);
  for (const [kind, [sign, name]] of Object.entries(SIGNS)) if (kinds.has(kind)) entries.push([sign, look[kind], name]);
  if (world.places.length) entries.push(["+", look.rim, "named place"]);
  return entries;
}

/** The elements of a legend. */
function legendElements(entries) {
  return entries.map(([sign, color, name]) => {
    const swatch = make("b", { ariaHidden: "true" }, sign);
    swatch.style.color = color;
    return make("span", {}, swatch, ` ${name}`);
  });
}
