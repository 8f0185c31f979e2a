// Adds alt texts to images in cell outputs, which JupyterLab omits.

export function imageRenderer(lab, options) {
  class Image extends lab.RenderedImage {
    constructor(settings) {
      super(settings);
    }

    async renderModel(model) {
      await super.renderModel(model);
      const alt = model.metadata["image/png"]?.alt;
      if (typeof alt === "string") this.node.querySelector("img")?.setAttribute("alt", alt);
    }
  }
  return new Image(options);
}
