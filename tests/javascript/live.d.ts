// The module that the stand-alone robot's page loads: ../../sim/view/web/live.js with what it uses.

declare const view: { render(context: { model: any; el: Element }): () => void };
export default view;
