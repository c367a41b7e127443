/** A result as the views read it, made from the header and arrays of the server's reply. Pure. */

/** Arrays that the page requests with every run. */
export const LIVE_ARRAYS = [
  "radiated_pressure_pa",
  "glottal_flow_m3_s",
  "glottal_area_m2",
  "contact_pressure_max_pa",
  "medial_plane_m",
  "cycle_time_s",
  "cycle_w_m",
  "cycle_aerodynamic_pressure_pa",
  "cycle_contact_pressure_pa",
  "x_m",
  "y_m",
];

/**
 * `waves` start at `startS` (0 for a whole run). `fields` hold one cycle, shape (phases, nx, ny), and `cycle` says
 * when it was: `startS`, `periodS`, `complete` (false: nothing repeats, the fields are the last 10 ms). Of two
 * different folds x, y, medial and w are those of the left one.
 */
export function makeResult({ header, arrays }, startS = 0) {
  const rate = header.provenance.sample_rate_hz;
  const times = arrays.cycle_time_s.data;
  const [phases, nx, ny] = arrays.cycle_w_m.shape.slice(-3);
  const data = (name) => arrays[name].data;
  const ofLeft = (name, size) => data(name).subarray(0, size); // the left fold comes first where the two differ
  return {
    id: header.id,
    state: header.phonation_state,
    explanation: header.explanation,
    periodicity: header.periodicity,
    cycles: header.cycles,
    measures: header.measures,
    posture: header.posture,
    provenance: header.provenance,
    rate,
    startS,
    durationS: startS + data("glottal_flow_m3_s").length / rate,
    waves: {
      pressure: data("radiated_pressure_pa"),
      flow: data("glottal_flow_m3_s"),
      area: data("glottal_area_m2"),
      contact: data("contact_pressure_max_pa"),
    },
    cycle: {
      startS: times[0],
      periodS: ((times[phases - 1] - times[0]) * phases) / (phases - 1),
      complete: header.cycle_is_complete,
    },
    fields: {
      phases,
      nx,
      ny,
      x: ofLeft("x_m", nx),
      y: ofLeft("y_m", ny),
      medial: ofLeft("medial_plane_m", nx * ny),
      w: ofLeft("cycle_w_m", phases * nx * ny),
      aero: data("cycle_aerodynamic_pressure_pa"),
      contact: data("cycle_contact_pressure_pa"),
      aeroRange: extent(data("cycle_aerodynamic_pressure_pa")),
      contactRange: extent(data("cycle_contact_pressure_pa")),
    },
  };
}

export const isVoiced = (result) => result !== null && result.state !== "none";

/** Value of a measure, or null. */
export const measured = (result, key) => result?.measures[key]?.value ?? null;

/** One moment of a field, interpolated between the two stored phases around it: Float32Array (nx·ny). */
export function fieldAt(fields, name, phase) {
  const { phases, nx, ny } = fields;
  const values = fields[name];
  const size = nx * ny;
  const position = phase * phases;
  const first = Math.floor(position) % phases;
  const next = (first + 1) % phases;
  const share = position - Math.floor(position);
  const out = new Float32Array(size);
  for (let k = 0; k < size; k++) {
    const a = values[first * size + k];
    out[k] = a + share * (values[next * size + k] - a);
  }
  return out;
}

/** Phase 0 to 1 of an instant, counted from the start of the stored cycle. */
export function phaseOf(result, timeS) {
  const turns = (timeS - result.cycle.startS) / result.cycle.periodS;
  return turns - Math.floor(turns);
}

/** {min, max} of one field over the whole cycle. */
export function extent(values) {
  let min = Infinity;
  let max = -Infinity;
  for (const v of values) {
    if (v < min) min = v;
    if (v > max) max = v;
  }
  return { min, max };
}
