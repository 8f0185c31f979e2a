// Questions about the next run with answers to click, and what happened beside the prediction; ../prediction.py makes
// their HTML. It needs no kernel. JupyterLab's extension listens for the event
// "ros2-prediction" and saves the answer.

const STORE = "ros2-course-predictions"; // in the browser: question -> letter
const READY = "data-ready";
const REVEAL = "ros2-reveal"; // an event at an outcome

/** Whether it was recorded before the page was opened, as on the web site: without a prediction it stays hidden. */
const isRecorded = ({ dataset }) => "recorded" in dataset;

function stored() {
  try {
    return JSON.parse(localStorage.getItem(STORE) ?? "{}") ?? {};
  } catch {
    return {}; // none, or a page that may not store anything
  }
}

/**
 * The letter that was predicted for the question of a card or an outcome; "" if none.
 * @param {HTMLElement | {dataset: DOMStringMap}} place
 */
function predicted({ dataset }) {
  const letter = dataset.predicted || stored()[dataset.question];
  return Object.hasOwn(answersOf({ dataset }), letter) ? letter : "";
}

function answersOf({ dataset }) {
  try {
    return JSON.parse(dataset.answers) ?? {};
  } catch {
    return {};
  }
}

const sameQuestion = (kind, { dataset }) =>
  [.../** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(`.ros2-${kind}`))].filter((other) => other.dataset.question === dataset.question);

/** Show the answers of a question as buttons. */
function installPrediction(card) {
  card.setAttribute(READY, "");
  card.setAttribute("role", "group");
  card.setAttribute("aria-label", "Prediction");
  const buttons = [...card.querySelectorAll("li[data-letter]")].map((item) => {
    const { letter } = item.dataset;
    const [name, ...answer] = item.childNodes;
    const choice = make("button", { type: "button" }, name, make("span", {}, ...answer));
    choice.dataset.letter = letter;
    choice.addEventListener("click", () => choose(card, letter));
    return choice;
  });
  card.querySelector("ul")?.replaceWith(...buttons, make("p", { className: "state", role: "status" }));
  showChoice(card);
}

function choose(card, letter) {
  try {
    localStorage.setItem(STORE, JSON.stringify({ ...stored(), [card.dataset.question]: letter }));
  } catch {
    // this page has the answer as long as it is open
  }
  card.dataset.predicted = letter;
  const { question } = card.dataset;
  card.dispatchEvent(new CustomEvent("ros2-prediction", { bubbles: true, detail: { question, answers: answersOf(card), letter } }));
  showChoice(card);
  for (const outcome of sameQuestion("outcome", card)) outcome.dispatchEvent(new Event(REVEAL));
}

function showChoice(card) {
  const letter = predicted(card), outcomes = sameQuestion("outcome", card);
  const recorded = !letter && outcomes.some(isRecorded), known = outcomes.length > 0 && !recorded;
  for (const choice of card.querySelectorAll("button")) {
    choice.setAttribute("aria-pressed", String(choice.dataset.letter === letter));
    choice.disabled = known;
  }
  const state = card.querySelector(".state");
  if (state) state.textContent = letter ? "Your prediction is saved. Run the next cells to see what happens." : "";
  if (state && recorded) state.textContent = "Choose an answer. Then you see below what happened.";
  if (state && known) state.textContent = letter ? "" : "You made no prediction before the run.";
}

/** Show the prediction beside what happened. */
function installOutcome(place) {
  place.setAttribute(READY, "");
  place.setAttribute("role", "status");
  const card = sameQuestion("prediction", place)[0];
  const letter = predicted(place) || (card ? predicted(card) : "");
  if (isRecorded(place) && !letter) {
    hideOutcome(place);
    if (card) showChoice(card);
    return;
  }
  const answers = answersOf(place), right = letter === place.dataset.happened;
  if (letter) {
    place.classList.add(right ? "right" : "other");
    place.prepend(make("p", {}, make("b", {}, "You predicted: "), ...codes(answers[letter])));
  }
  if (right) place.append(make("p", { className: "state" }, "That's right."));
  if (card) showChoice(card);
}

/** Hide what happened until there is a prediction, or it is asked for. */
function hideOutcome(place) {
  const content = [...place.childNodes], show = make("button", { type: "button" }, "Show what happened");
  show.addEventListener("click", () => place.dispatchEvent(new Event(REVEAL)));
  place.replaceChildren(make("p", {}, "Answer the question above first. "), show);
  place.addEventListener(REVEAL, () => {
    place.replaceChildren(...content);
    delete place.dataset.recorded;
    installOutcome(place);
  }, { once: true });
}

/** A text as elements: `...` is code. */
function codes(text) {
  return text.split("`").map((part, index) => (index % 2 ? make("code", {}, part) : part));
}

if (!document.querySelector("style.ros2-predictions")) {
  document.head.append(make("style", { className: "ros2-predictions" }, STYLE));
}
document.querySelectorAll(`.ros2-prediction:not([${READY}])`).forEach(installPrediction);
document.querySelectorAll(`.ros2-outcome:not([${READY}])`).forEach(installOutcome);
