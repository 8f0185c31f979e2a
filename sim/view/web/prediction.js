// A question about the next run, with answers to click: ../prediction.py creates it, and gets the clicked answer.

export default {
  render({ model, el }) {
    const question = make("p", {}, make("b", {}, "Predict: "), ...codes(model.get("question")));
    const predicted = model.get("predicted");
    const answers = Object.entries(model.get("answers")).map(([letter, answer]) => {
      const label = make("span", {}, ...codes(answer), letter === predicted ? make("i", {}, " (your last prediction)") : "");
      const choice = make("button", { type: "button" }, make("b", {}, letter), label);
      choice.addEventListener("click", () => {
        for (const each of answers) each.disabled = true; // one click counts; the kernel may be busy
        choice.classList.add("chosen");
        model.send({ answer: letter });
      });
      return choice;
    });
    const root = make("div", { className: "ros2-prediction", role: "group", "aria-label": "Prediction" }, make("style", {}, STYLE));
    root.append(question, ...answers);
    el.append(root);
  },
};

/** A text as elements: `...` is code. */
function codes(text) {
  return text.split("`").map((part, index) => (index % 2 ? make("code", {}, part) : part));
}
