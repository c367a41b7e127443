/**
 * Saves files: the pictures that are on the page now, painted again by their own painters, and any other content.
 * Nothing leaves the machine.
 */
import { signal } from "./ui.js";
import { SvgContext } from "./svg-context.js";

const PNG_RATIO = 3; // for print at 300 dpi
const shown = signal([]);

/** The mounted pictures that have a title: {name, title, model, paint, size} or {name, title, make}. */
export const figures = shown;

/** Offer a picture for export while it is on the page; returns a function that withdraws it. */
export function offer(figure) {
  shown.value = [...shown.peek(), figure];
  return () => (shown.value = shown.peek().filter((other) => other !== figure));
}

/** The figure as SVG text or a PNG blob, or null while it is empty. Some figures `make(kind)` their own file. */
export function figureFile(figure, kind, ground) {
  if (figure.make) return figure.make(kind);
  return kind === "svg" ? svgOf(figure, ground) : pngOf(figure, ground);
}

/** The figure as SVG text; null while it is empty. */
export function svgOf({ title, model, paint, size }, ground) {
  const seen = model();
  if (!seen) return null;
  const { width, height } = size();
  const context = new SvgContext(width, height, title);
  paint(context, { width, height }, seen);
  return context.text(ground);
}

/** The figure as a PNG blob, three pixels for one of the page; null while it is empty. */
export function pngOf({ model, paint, size }, ground) {
  const seen = model();
  if (!seen) return null;
  const { width, height } = size();
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * PNG_RATIO);
  canvas.height = Math.round(height * PNG_RATIO);
  const context = canvas.getContext("2d");
  context.isFigure = true;
  context.scale(PNG_RATIO, PNG_RATIO);
  context.fillStyle = ground;
  context.fillRect(0, 0, width, height);
  paint(context, { width, height }, seen);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

const FREE_S = 10; // by then every browser has taken the file

/** Offer `content` (Blob or text) as a download. */
export function download(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const address = URL.createObjectURL(blob);
  const anchor = Object.assign(document.createElement("a"), { href: address, download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), FREE_S * 1e3);
}

/** Download a figure. `kind`: svg or png. */
export async function exportFigure(figure, kind, ground) {
  const content = await figureFile(figure, kind, ground);
  if (content) download(`vocalis-${figure.name}.${kind}`, content, "image/svg+xml");
}
