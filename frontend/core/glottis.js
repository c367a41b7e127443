/**
 * The glottis from above as outlines in mm. Pure.
 *
 * u is measured along the fold from the vocal process and is negative towards the anterior commissure. The posterior
 * end does not move on the page, so a longer fold visibly carries the thyroid cartilage forward. r is the distance of
 * one fold from the midline, r = G − w (the other fold mirrors it); where r is negative the tissue is pressed into the
 * other fold.
 */

const MM = 1e3;

/**
 * Edges of one fold for displacements `w` (nx·ny): {u, superior, inferior, inner}, mm. `inner` is the edge nearest
 * to the midline over the whole depth, as a laryngoscope sees it.
 */
export function foldEdges({ nx, ny, x, medial }, w) {
  const length = x[nx - 1];
  const edges = { u: [], superior: [], inferior: [], inner: [], lengthMm: length * MM };
  for (let i = 0; i < nx; i++) {
    let inner = Infinity;
    for (let j = 0; j < ny; j++) inner = Math.min(inner, medial[i * ny + j] - w[i * ny + j]);
    edges.u.push((x[i] - length) * MM);
    edges.superior.push((medial[i * ny] - w[i * ny]) * MM);
    edges.inferior.push((medial[i * ny + ny - 1] - w[i * ny + ny - 1]) * MM);
    edges.inner.push(inner * MM);
  }
  return edges;
}

/** The same from the posture call, which sends only the two edges. */
export function staticEdges({ x_m, superior_m, inferior_m, medial_superior_m, medial_inferior_m }) {
  const length = x_m[x_m.length - 1];
  const superior = superior_m.map((w, i) => (medial_superior_m[i] - w) * MM);
  const inferior = inferior_m.map((w, i) => (medial_inferior_m[i] - w) * MM);
  return {
    u: x_m.map((x) => (x - length) * MM),
    superior,
    inferior,
    inner: superior.map((r, i) => Math.min(r, inferior[i])),
    lengthMm: length * MM,
  };
}

/** Largest contact pressure over the depth at each x, Pa. */
export function contactAlong({ nx, ny }, contact) {
  return Array.from({ length: nx }, (_, i) => {
    let most = 0;
    for (let j = 0; j < ny; j++) most = Math.max(most, contact[i * ny + j]);
    return most;
  });
}
