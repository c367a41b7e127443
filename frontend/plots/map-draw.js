/** A heat map of the medial surface: x from anterior to posterior, y from superior down to inferior. */
import { colourScale } from "./colours.js";

/** Paint `values` (nx·ny, x outermost) into `image` (nx wide, ny high). */
export function fillImage(image, values, nx, ny, scale) {
  for (let i = 0; i < nx; i++) {
    for (let j = 0; j < ny; j++) {
      const [table, at] = scale(values[i * ny + j]);
      const pixel = 4 * (j * nx + i);
      image.data[pixel] = table[at];
      image.data[pixel + 1] = table[at + 1];
      image.data[pixel + 2] = table[at + 2];
      image.data[pixel + 3] = 255;
    }
  }
  return image;
}

/** Draws maps of one grid size; keeps a small canvas of one pixel per node. */
export class MapPainter {
  #grid = document.createElement("canvas");

  /** `box` {x, y, width, height} is where the outermost nodes lie; colours are interpolated between nodes. */
  draw(context, box, values, { nx, ny }, { kind, limit }, theme) {
    if (this.#grid.width !== nx || this.#grid.height !== ny) {
      this.#grid.width = nx;
      this.#grid.height = ny;
    }
    const grid = this.#grid.getContext("2d");
    grid.putImageData(fillImage(grid.createImageData(nx, ny), values, nx, ny, colourScale(kind, limit, theme)), 0, 0);
    context.imageSmoothingEnabled = true;
    context.imageSmoothingQuality = "high";
    // Node centres to node centres: the half pixel around the grid is left out.
    context.drawImage(this.#grid, 0.5, 0.5, nx - 1, ny - 1, box.x, box.y, box.width, box.height);
  }
}

/** A vertical bar of the scale between `low` and `high`. */
export function drawColourBar(context, box, { kind, limit, low }, theme) {
  const scale = colourScale(kind, limit, theme);
  const rows = Math.max(2, Math.round(box.height));
  for (let k = 0; k < rows; k++) {
    const value = limit - (k / (rows - 1)) * (limit - low);
    const [table, at] = scale(value);
    context.fillStyle = `rgb(${table[at]} ${table[at + 1]} ${table[at + 2]})`;
    context.fillRect(box.x, box.y + k, box.width, 1.5);
  }
}
