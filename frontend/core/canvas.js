/** Canvases that are sharp on every screen. */

/**
 * The 2-d context of `canvas` in CSS pixels for a box of `width` by `height`, cleared; null when it has no size.
 * `ground`: a colour that fills it, so the browser need not blend it.
 */
export function prepare(canvas, width, height, ground = null) {
  if (width < 2 || height < 2) return null;
  const ratio = Math.min(window.devicePixelRatio || 1, 3);
  const w = Math.round(width * ratio);
  const h = Math.round(height * ratio);
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  const context = canvas.getContext("2d", { alpha: ground === null });
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  if (ground === null) {
    context.clearRect(0, 0, width, height);
  } else {
    context.fillStyle = ground;
    context.fillRect(0, 0, width + 1, height + 1); // the last row may be a fraction of a pixel
  }
  return context;
}

/** A picture that seldom changes: painted once, copied in every frame. */
export class Layer {
  #canvas = document.createElement("canvas");
  #made = null;

  /** Draw the picture of `paint(context, box, model)`, painted again when `model` or the box changes. */
  draw(context, box, model, paint) {
    if (context.isFigure) return paint(context, box, model); // a file has its own resolution
    if (this.#made?.model !== model || this.#made.width !== box.width || this.#made.height !== box.height) {
      paint(prepare(this.#canvas, box.width, box.height), box, model);
      this.#made = { model, width: box.width, height: box.height };
    }
    context.save();
    context.resetTransform();
    context.drawImage(this.#canvas, 0, 0);
    context.restore();
  }
}

/** A smooth line through points [[x, y], …] (Catmull–Rom), added to the current path. */
export function smoothLine(context, points, { move = true } = {}) {
  if (move) context.moveTo(...points[0]);
  else context.lineTo(...points[0]);
  const at = (k) => points[Math.max(0, Math.min(points.length - 1, k))];
  for (let k = 0; k < points.length - 1; k++) {
    const [a, b, c, d] = [at(k - 1), at(k), at(k + 1), at(k + 2)];
    context.bezierCurveTo(
      b[0] + (c[0] - a[0]) / 6,
      b[1] + (c[1] - a[1]) / 6,
      c[0] - (d[0] - b[0]) / 6,
      c[1] - (d[1] - b[1]) / 6,
      c[0],
      c[1],
    );
  }
}
