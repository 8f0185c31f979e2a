// The stand-alone robot's page: the notebook's live view, connected to this server instead of a kernel.
import live from "/live.js";

const GONE = "The robot's program has ended. Start it again, then reload this page.";

const { world, status } = await (await fetch("/world")).json();
const values = { world, status, graph: {} };
const listeners = {};
const emit = (name, ...values) => (listeners[name] ?? []).forEach((listener) => listener(...values));

const model = {
  get: (name) => values[name],
  on: (name, listener) => (listeners[name] ??= []).push(listener),
  off: (name, listener) => { listeners[name] = (listeners[name] ?? []).filter((other) => other !== listener); },
  send: (command) => (command.graph ? loadGraph() : drive(command)).catch(() => {}), // the stream reports a lost connection
};

function drive(command) {
  const headers = { "Content-Type": "application/json" };
  return fetch("/drive", { method: "POST", headers, body: JSON.stringify(command) });
}

async function loadGraph() {
  const graph = await (await fetch("/graph")).text();
  if (graph === loadGraph.last) return;
  loadGraph.last = graph;
  values.graph = JSON.parse(graph);
  emit("change:graph");
}

document.title = `Robot in ${world.name}`;
live.render({ model, el: document.querySelector("main") });

const stream = new EventSource("/frames");
stream.onmessage = ({ data }) => {
  const bytes = Uint8Array.from(atob(data), (character) => character.charCodeAt(0));
  emit("msg:custom", {}, [new DataView(bytes.buffer)]);
};
stream.addEventListener("status", ({ data }) => {
  values.status = { ...values.status, ...JSON.parse(data) };
  emit("change:status");
});
stream.onerror = () => {
  stream.close();
  values.status = { ...values.status, ended: ["gone", GONE] };
  emit("change:status");
};
