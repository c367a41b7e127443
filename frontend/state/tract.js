/** The vocal tract of the present vowel, as the server describes it. */
import { computed, signal } from "../ui.js";
import { values } from "./request.js";

const AIR = ["rho_a_kg_m3", "c_a_m_s"];
const _known = signal(new Map());

/** Address of the tract that the present settings speak through; null before there are any. */
export const tractPath = computed(() => {
  const { vowel } = values.value;
  if (typeof vowel !== "string") return null;
  const air = AIR.map((name) => [name, values.value[`constants.${name}`]]).filter(([, value]) => Number.isFinite(value));
  return `tract/${encodeURIComponent(vowel)}?${new URLSearchParams(air)}`;
});

/** {vowel, ipa, source, section_length_m, areas_m2, formants, frequency_hz, lip_pressure_per_flow_pa_s_m3}, or null. */
export const tract = computed(() => _known.value.get(tractPath.value) ?? null);

export function takeTract(path, answer) {
  _known.value = new Map(_known.peek()).set(path, answer);
}
