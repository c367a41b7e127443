/** A field of the medial surface as an image of one pixel per node: x from anterior to posterior, y superior to inferior. */
import { colourWriter } from "./colours.js";

/** Write `values` (nx·ny, x outermost) into `image` (nx wide, ny high). */
export function fillImage(image, values, scale, theme) {
  const { width: nx, height: ny, data } = image;
  const write = colourWriter(scale, theme);
  for (let i = 0; i < nx; i++) {
    for (let j = 0; j < ny; j++) {
      const pixel = 4 * (j * nx + i);
      write(values[i * ny + j], data, pixel);
      data[pixel + 3] = 255;
    }
  }
  return image;
}

/** Paint onto `canvas`, which the page stretches smoothly from node to node. */
export function paintField(canvas, { nx, ny }, values, scale, theme) {
  if (canvas.width !== nx || canvas.height !== ny) {
    canvas.width = nx;
    canvas.height = ny;
  }
  const context = canvas.getContext("2d");
  context.putImageData(fillImage(context.createImageData(nx, ny), values, scale, theme), 0, 0);
}
