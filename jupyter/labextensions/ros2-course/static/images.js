// Pictures of a cell's output with the words that stand for them, which JupyterLab leaves out by itself.

export function imageRenderer(lab, options) {
  class Image extends lab.RenderedImage {
    async renderModel(model) {
      await super.renderModel(model);
      const words = model.metadata["image/png"]?.alt;
      if (typeof words === "string") this.node.querySelector("img")?.setAttribute("alt", words);
    }
  }
  return new Image(options);
}
