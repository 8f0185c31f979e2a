// The stand-alone robot's page: the notebook's live view, connected to this server instead of a kernel.
import live from "/live.js";

const GONE = "The robot's program has ended. When it is started again, this page connects to it by itself.";
const RETRY = 1000; // ms between two attempts to connect again

const { world, status } = await (await fetch("/world")).json();
const LAYERS = ["layers", "quiet", "shown"]; // are sent with the status
const values = { world, status, graph: {} };
const listeners = {};
const emit = (name, ...values) => (listeners[name] ?? []).forEach((listener) => listener(...values));

const model = {
  get: (name) => values[name],
  set: (name, value) => { values[name] = value; },
  save_changes: () => post({ shown: values.shown }).catch(() => {}),
  on: (name, listener) => (listeners[name] ??= []).push(listener),
  off: (name, listener) => { listeners[name] = (listeners[name] ?? []).filter((other) => other !== listener); },
  send: (command) => (command.graph ? loadGraph() : post(command)).catch(() => {}), // the stream reports a lost connection
};

function post(command) {
  const headers = { "Content-Type": "application/json" };
  return fetch("/command", { method: "POST", headers, body: JSON.stringify(command) });
}

let lastGraph = ""; // as text

async function loadGraph() {
  const graph = await (await fetch("/graph")).text();
  if (graph === lastGraph) return;
  lastGraph = graph;
  values.graph = JSON.parse(graph);
  emit("change:graph");
}

document.title = `Robot in ${world.name}`;
live.render({ model, el: document.querySelector("main") });

const stream = new EventSource("/frames");
stream.onmessage = ({ data }) => {
  const [frame, layers] = JSON.parse(data);
  const bytes = Uint8Array.from(atob(frame), (character) => character.charCodeAt(0));
  emit("msg:custom", { layers }, [new DataView(bytes.buffer)]);
};
stream.addEventListener("status", ({ data }) => {
  const { layers, quiet, shown, ...news } = JSON.parse(data), parts = { layers, quiet, shown };
  for (const name of LAYERS) {
    if (JSON.stringify(parts[name]) === JSON.stringify(values[name])) continue;
    values[name] = parts[name];
    emit(`change:${name}`);
  }
  values.status = { ...values.status, ...news };
  emit("change:status");
});
stream.onerror = () => {
  stream.close();
  values.status = { ...values.status, ended: ["gone", GONE] };
  emit("change:status");
  setTimeout(reconnect, RETRY);
};

/** Load the page again as soon as a robot's program answers: it may have another world. */
async function reconnect() {
  const answer = await fetch("/world").catch(() => null);
  if (answer?.ok) location.reload();
  else setTimeout(reconnect, RETRY);
}
