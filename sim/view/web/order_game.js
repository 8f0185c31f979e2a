// Callbacks of a node, of which the user picks the one that continues next; ../order_game.py has the node. Keys: the
// number of a callback, Backspace to undo, R to start again.

const WORDS = { waiting: "is due", running: "has begun", blocked: "waits for a lock", done: "done" };

class OrderGame {
  constructor(model) {
    this.model = model;
    this.calls = make("div", { className: "calls" });
    this.values = make("p");
    this.watched = make("p");
    this.done = make("ol");
    this.status = make("p", { className: "state", role: "status" });
    this.orders = make("span", { className: "small" });
    this.undo = make("button", { type: "button" }, "Undo (Backspace)");
    this.again = make("button", { type: "button" }, "Start again (R)");
    this.undo.addEventListener("click", () => this.model.send({ undo: true }));
    this.again.addEventListener("click", () => this.model.send({ restart: true }));
    const help = "You are the executor: which callback continues? Click, or press its number.";
    this.root = make("div", { className: "ros2-game", tabIndex: 0, role: "group" }, make("style", {}, STYLE), make("p", { className: "small" }, help),
      this.calls, this.values, this.watched, this.status, make("p", {}, this.undo, " ", this.again, " ", this.orders), this.done);
    this.root.setAttribute("aria-label", "Which callback continues next");
    this.root.dataset.lmSuppressShortcuts = "true"; // keys are picks, and no commands of the notebook
    this.root.addEventListener("keydown", (event) => this.key(event));
    this.buttons = [];
    this.update = () => this.show(model.get("state"));
    model.on("change:state", this.update);
    this.update();
  }

  close() {
    this.model.off("change:state", this.update);
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const number = Number(event.key), { choices } = this.model.get("state");
    if (choices.includes(number)) this.model.send({ pick: number });
    else if (event.key === "Backspace") this.model.send({ undo: true });
    else if (event.key.toLowerCase() === "r") this.model.send({ restart: true });
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  show(state) {
    if (this.buttons.length !== state.calls.length) this.build(state);
    state.calls.forEach((call, index) => this.showCall(call, index, state));
    const names = Object.entries(state.values).map(([name, value]) => `self.${name} = ${value}`);
    this.values.replaceChildren("The node: ", make("code", {}, names.join(", ") || "no attributes"));
    this.watched.textContent = state.watched;
    this.watched.hidden = !state.watched;
    this.status.textContent = state.text;
    this.orders.textContent = state.orders ? `Orders played to the end: ${state.orders}` : "";
    this.undo.disabled = this.again.disabled = !state.done.length;
    this.done.replaceChildren(...state.done.map((text) => make("li", {}, text)));
    this.root.classList.toggle("broken", state.holds === false);
    this.root.classList.toggle("holds", state.holds === true);
  }

  /** Make the callbacks' columns; later only their state changes, so that a button keeps the focus. */
  build(state) {
    const columns = state.calls.map((call, index) => {
      const choice = make("button", { type: "button" });
      choice.addEventListener("click", () => this.model.send({ pick: index + 1 }));
      const code = make("pre", {}, ...call.lines.map(([number, text]) => {
        const line = make("span", {}, text || " ");
        line.dataset.line = String(number);
        return line;
      }));
      return { choice, code };
    });
    this.buttons = columns;
    this.calls.replaceChildren(...columns.map(({ choice, code }) => make("div", { className: "call" }, choice, code)));
  }

  showCall(call, index, state) {
    const { choice, code } = this.buttons[index], possible = state.choices.includes(index + 1);
    const words = call.state === "waiting" && !possible && state.holds === null ? "later" : WORDS[call.state];
    choice.replaceChildren(make("b", {}, String(index + 1)), ` ${call.name}: ${words}`);
    if (choice === document.activeElement && !possible) this.root.focus(); // a disabled button would lose the keys
    choice.disabled = !possible;
    for (const line of code.children) line.classList.toggle("next", call.line > 0 && line.dataset.line === String(call.line));
  }
}

export default {
  render({ model, el }) {
    const game = new OrderGame(model);
    el.append(game.root);
    return () => game.close();
  },
};
