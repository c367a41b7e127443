/** A canvas that is sharp on every screen. */

/** The 2-d context of `canvas` in CSS pixels for a box of `width` by `height`, cleared; null when it has no size. */
export function prepare(canvas, width, height) {
  if (width < 2 || height < 2) return null;
  const ratio = Math.min(window.devicePixelRatio || 1, 3);
  const w = Math.round(width * ratio);
  const h = Math.round(height * ratio);
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}

/** A smooth line through points [[x, y], …] (Catmull–Rom), added to the current path. */
export function smoothLine(context, points, { move = true } = {}) {
  if (move) context.moveTo(...points[0]);
  else context.lineTo(...points[0]);
  const at = (k) => points[Math.max(0, Math.min(points.length - 1, k))];
  for (let k = 0; k < points.length - 1; k++) {
    const [a, b, c, d] = [at(k - 1), at(k), at(k + 1), at(k + 2)];
    context.bezierCurveTo(
      b[0] + (c[0] - a[0]) / 6, b[1] + (c[1] - a[1]) / 6,
      c[0] - (d[0] - b[0]) / 6, c[1] - (d[1] - b[1]) / 6,
      c[0], c[1],
    );
  }
}
