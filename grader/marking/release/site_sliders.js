// Sliders that show what was recorded for their values; site_sliders.py makes their HTML. The text of an output is its value.

for (const place of document.querySelectorAll(".ros2-recorded:not([data-ready])")) {
  place.setAttribute("data-ready", "");
  const sliders = [...place.querySelectorAll("input")], outcomes = [...place.querySelectorAll("template")];
  const starts = sliders.map(({ value }) => value), show = place.querySelector(".outcome");
  let shown = -1;
  const update = (moved) => {
    sliders.forEach((slider, index) => {
      if (slider !== moved) slider.value = starts[index];
      const value = slider.dataset.values.split(" ")[Number(slider.value)];
      slider.nextElementSibling.value = value;
      slider.setAttribute("aria-valuetext", value);
    });
    const wanted = Number(moved.dataset.outcomes.split(" ")[Number(moved.value)]);
    if (wanted !== shown) show.replaceChildren(outcomes[shown = wanted].content.cloneNode(true));
  };
  for (const slider of sliders) slider.addEventListener("input", () => update(slider));
  update(sliders[0]);
}
