// The colors of pictures on light and dark pages.

const TURTLES = ["#7bc96f", "#f2b84b", "#e8807f", "#d9a5e8"]; // on a pond's background
const LIGHT = {
  ground: "#f3f5f7", floor: "#ffffff", grid: "rgba(30,50,70,.08)", ink: "#46525f", wall: "#3a4550",
  solid: "#d3dae1", edge: "#74808d", ray: "rgba(236,140,30,.17)", far: "rgba(236,140,30,.07)", hit: "#e06a10",
  ahead: "rgba(60,110,170,.28)", goal: "#efb021", rim: "#9a6a00", contact: "#d93a35", nose: "#ffffff",
  robots: ["#2274c4", "#8a4fc0", "#158a6b", "#c2477f"], box: "#d9b991", person: "#f08a5d", link: "#3d9aa1", cart: "#7d8fa3", turtles: TURTLES,
  ghost: "rgba(70,85,100,.28)", plan: "rgba(28,154,75,.6)", aim: "#b3541e", belief: "#0b7285", doubt: "rgba(11,114,133,.18)", axes: ["#c92a2a", "#2b8a3e", "#1864ab"], failure: "#b3261e",
};
const DARK = {
  ground: "#15181b", floor: "#1e2328", grid: "rgba(255,255,255,.065)", ink: "#b9c4cf", wall: "#c4ced8",
  solid: "#3d4853", edge: "#8a97a4", ray: "rgba(255,170,70,.17)", far: "rgba(255,170,70,.07)", hit: "#ffa24d",
  ahead: "rgba(120,180,240,.3)", goal: "#f5c044", rim: "#ffe2a0", contact: "#ff6b62", nose: "#10161c",
  robots: ["#5aa9f0", "#b98be6", "#3cc39d", "#ea80b0"], box: "#a5855c", person: "#f29b74", link: "#4fb0b8", cart: "#7f93a8", turtles: TURTLES,
  ghost: "rgba(200,215,230,.28)", plan: "rgba(76,199,122,.65)", aim: "#ff9d5c", belief: "#4fd1e5", doubt: "rgba(79,209,229,.2)", axes: ["#ff7b72", "#69db7c", "#74b0f4"], failure: "#ff8a80",
};

/** Call `update` when the page may have changed its theme, while the element is in the page. */
function onTheme(element, update) {
  const soon = () => {
    if (!element.isConnected) { stop(); return; }
    update();
    setTimeout(update, 400); // JupyterLab loads the theme's colors with a delay
  };
  const watch = new MutationObserver(soon);
  watch.observe(document.documentElement, { attributes: true });
  watch.observe(document.body, { attributes: true });
  const scheme = matchMedia("(prefers-color-scheme: dark)");
  scheme.addEventListener("change", soon);
  const stop = () => { watch.disconnect(); scheme.removeEventListener("change", soon); };
}

/** The colors for an element: a light text color means a dark page. */
function colors(element) {
  const [red, green, blue] = (getComputedStyle(element).color.match(/[\d.]+/g) || [0, 0, 0]).map(Number);
  return 0.3 * red + 0.6 * green + 0.1 * blue > 128 ? DARK : LIGHT;
}
