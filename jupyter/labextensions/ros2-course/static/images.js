// Adds alt texts to images in cell outputs, which JupyterLab omits. Those that have one are the course's plots.

export function imageRenderer(lab, options) {
  class Image extends lab.RenderedImage {
    constructor(settings) {
      super(settings);
    }

    async renderModel(model) {
      await super.renderModel(model);
      const alt = model.metadata["image/png"]?.alt;
      if (typeof alt !== "string") return;
      const image = this.node.querySelector("img");
      image?.setAttribute("alt", alt);
      image?.classList.add("ros2-course-plot");
    }
  }
  return new Image(options);
}
