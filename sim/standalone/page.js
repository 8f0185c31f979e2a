// The stand-alone robot's page: the notebook's live view, with a stream of this server's in place of a kernel.
import live from "/live.js";

const GONE = "The robot's program has ended. Start it again, then reload this page.";

const { world, status } = await (await fetch("/world")).json();
const values = { world, status, graph: {} };
const listeners = {};
const tell = (name, ...what) => (listeners[name] ?? []).forEach((act) => act(...what));

const model = {
  get: (name) => values[name],
  on: (name, act) => (listeners[name] ??= []).push(act),
  off: (name, act) => { listeners[name] = (listeners[name] ?? []).filter((other) => other !== act); },
  send: (command) => (command.graph ? look() : drive(command)).catch(() => {}), // the stream says if the robot is gone
};

function drive(command) {
  const headers = { "Content-Type": "application/json" };
  return fetch("/drive", { method: "POST", headers, body: JSON.stringify(command) });
}

async function look() {
  const graph = await (await fetch("/graph")).text();
  if (graph === look.last) return;
  look.last = graph;
  values.graph = JSON.parse(graph);
  tell("change:graph");
}

document.title = `Robot in ${world.name}`;
live.render({ model, el: document.querySelector("main") });

const stream = new EventSource("/frames");
stream.onmessage = ({ data }) => {
  const bytes = Uint8Array.from(atob(data), (character) => character.charCodeAt(0));
  tell("msg:custom", {}, [new DataView(bytes.buffer)]);
};
stream.addEventListener("status", ({ data }) => {
  values.status = { ...values.status, ...JSON.parse(data) };
  tell("change:status");
});
stream.onerror = () => {
  stream.close();
  values.status = { ...values.status, ended: ["gone", GONE] };
  tell("change:status");
};
