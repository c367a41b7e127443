/** Lines across the glottis and its width along, over the cycle. Pure. */

/** Shares of the length at which kymograms are usually read, anterior 0. */
export const LEVELS = [0.2, 0.35, 0.5, 0.65, 0.8];

export const CYCLES = 2;

/**
 * One fold along a line across the glottis at `level` of the length, for each stored phase: distances from the midline
 * in mm {superior, inferior, inner}, and the contact pressure there, Pa.
 */
export function kymogramOf({ phases, nx, ny, medial, w, contact }, level) {
  const position = level * (nx - 1);
  const first = Math.min(Math.floor(position), nx - 2);
  const share = position - first;
  const between = (values, from, j) => values[from + first * ny + j] * (1 - share) + values[from + (first + 1) * ny + j] * share;
  const lines = { superior: [], inferior: [], inner: [], contact: [] };
  for (let p = 0; p < phases; p++) {
    const from = p * nx * ny;
    let inner = Infinity;
    let pressed = 0;
    for (let j = 0; j < ny; j++) {
      const r = 1e3 * (between(medial, 0, j) - between(w, from, j));
      if (j === 0) lines.superior.push(r);
      if (j === ny - 1) lines.inferior.push(r);
      inner = Math.min(inner, r);
      pressed = Math.max(pressed, between(contact, from, j));
    }
    lines.inner.push(inner);
    lines.contact.push(pressed);
  }
  return lines;
}

/** Width of the glottis, mm, shape (phases, nx): twice the least distance from the midline, never below 0. */
export function vibrogramOf({ phases, nx, ny, medial, w }) {
  const width = new Float32Array(phases * nx);
  for (let p = 0; p < phases; p++) {
    for (let i = 0; i < nx; i++) {
      let inner = Infinity;
      for (let j = 0; j < ny; j++) inner = Math.min(inner, medial[i * ny + j] - w[p * nx * ny + i * ny + j]);
      width[p * nx + i] = 2e3 * Math.max(inner, 0);
    }
  }
  return width;
}
