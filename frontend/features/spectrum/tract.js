/** The vocal tract of the present vowel, fetched from the server when a picture first needs it. */
import { computed, effect, signal } from "../../core/ui.js";
import { getJson, Problem } from "../../core/api.js";
import { patch, values } from "../../state/request.js";

const AIRWAYS = ["airway_scale", "rho_a_kg_m3", "c_a_m_s"];
const _known = signal(new Map());

/** Address of the tract of the present settings; null before there are any. */
export const tractPath = computed(() => {
  const { vowel, "model.variant": variant } = values.value;
  if (typeof vowel !== "string") return null;
  const own = AIRWAYS.map((name) => [name, patch.value[`constants.${name}`]]).filter(([, value]) =>
    Number.isFinite(value),
  );
  const query = new URLSearchParams([["variant", variant], ...own]);
  return `tract/${encodeURIComponent(vowel)}?${query}`;
});

/** {vowel, ipa, source, section_length_m, areas_m2, formants, frequency_hz, lip_pressure_per_flow_pa_s_m3}, or null. */
export const tract = computed(() => _known.value.get(tractPath.value) ?? null);

export function takeTract(path, answer) {
  _known.value = new Map(_known.peek()).set(path, answer);
}

/** Starts following the vowel; returns a function that stops it. A refused vowel has no tract; its field says why. */
export function followTract() {
  const asked = new Set();
  return effect(() => {
    const path = tractPath.value;
    if (path === null || tract.value || asked.has(path)) return;
    asked.add(path);
    getJson(path).then(
      (answer) => takeTract(path, answer),
      (error) => {
        asked.delete(path);
        if (!(error instanceof Problem)) throw error;
      },
    );
  });
}
