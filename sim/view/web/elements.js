// Elements of a page: buttons with icons, a drop-down of speeds.

/** Creates an element with properties, and children: elements or text. */
function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

const SHAPES = {
  play: "M5 3v10l8-5z", pause: "M4 3h3v10H4zM9 3h3v10H9z", stop: "M4 4h8v8H4z",
  back: "M11 3v10L5 8zM3 3h2v10H3z", on: "M5 3v10l6-5zM11 3h2v10h-2z",
  more: "M7 3h2v4h4v2H9v4H7V9H3V7h4z", less: "M3 7h10v2H3z", whole: "M2 2h5v2H4v3H2zM9 2h5v5h-2V4H9zM2 9h2v3h3v2H2zM12 9h2v5H9v-2h3z",
  follow: "M7 1h2v2.1A5 5 0 0 1 12.9 7H15v2h-2.1A5 5 0 0 1 9 12.9V15H7v-2.1A5 5 0 0 1 3.1 9H1V7h2.1A5 5 0 0 1 7 3.1zM8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
  up: "M8 3l6 8H2z", down: "M8 13l6-8H2z", left: "M3 8l8-6v12z", right: "M13 8L5 2v12z",
};

/** An icon for a button: one of SHAPES. */
function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", SHAPES[name]);
  svg.append(path);
  return svg;
}

/** A button with an icon; the label is for its tooltip and for screen readers. */
function button(shape, label, onClick) {
  const element = make("button", { type: "button" });
  element.show = (shape, label) => {
    element.replaceChildren(icon(shape));
    element.title = label;
    element.setAttribute("aria-label", label);
  };
  element.show(shape, label);
  if (onClick) element.addEventListener("click", onClick);
  return element;
}

/** A drop-down of speeds; `onChange` is called with the selected number. */
function speeds(choices, onChange) {
  const select = make("select", { title: "Speed: simulated seconds in a second", "aria-label": "Speed" });
  select.put = (speed) => { // a speed that was set elsewhere may not be among the choices
    if (![...select.options].some((option) => Number(option.value) === speed)) {
      const label = speed === Infinity ? "as fast as possible" : `${speed} ×`;
      select.append(make("option", { value: speed }, label));
    }
    select.value = speed;
  };
  choices.forEach(select.put);
  select.addEventListener("change", () => onChange(Number(select.value)));
  return select;
}

/** The index of the last item that is not later than `stamp`; -1 if all are later. */
function before(items, stamp, of = (item) => item) {
  let low = 0, high = items.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (of(items[middle]) <= stamp + 1e-6) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

const stampOf = (item) => item.stamp;

/** A value of a plot with four digits, and without what is too small to be seen in the range of its values. */
function rounded(value, range) {
  const step = 10 ** (Math.floor(Math.log10(range || Math.abs(value) || 1)) - 3);
  return Number((Math.round(value / step) * step).toPrecision(4));
}
