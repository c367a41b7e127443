/** The map of pitch behind the pad. It is computed again when a setting other than CT and TA has changed. */
import { effect, readonly, signal, untracked } from "../../core/ui.js";
import { Problem } from "../../core/api.js";
import { patchText, simulationRequest } from "../../core/parameters.js";
import { patch, schema } from "../../state/request.js";
import { LIVE_S } from "../live/follow-request.js";
import { runSweep } from "../map/sweep.js";

const REST_MS = 1000;
const STEPS = 11;
const LEVELS = Array.from({ length: STEPS }, (_, k) => k / (STEPS - 1));
const AXES = [
  { paths: ["activation.ct"], values: LEVELS },
  { paths: ["activation.ta"], values: LEVELS },
];

const _map = signal(null);
let madeWith = "";
let making = false; // an unfinished map is started again

/** {ct, ta, fo} with fo in Hz, CT outermost, null where nothing repeats; null before the first map. */
export const padMap = readonly(_map);

/** Updates the map while the pad is shown; returns a function that stops it. */
export function followPad() {
  let waiting = 0;
  let control = new AbortController();
  let ended = Promise.resolve();
  const stop = effect(() => {
    if (!schema.value) return;
    const asked = otherSettings(patch.value);
    clearTimeout(waiting);
    if (asked === madeWith) return;
    waiting = setTimeout(() => {
      control.abort();
      control = new AbortController();
      const { signal: mine } = control;
      madeWith = asked;
      ended = ended.then(() => make(mine));
    }, REST_MS);
  });
  return () => {
    stop();
    clearTimeout(waiting);
    control.abort();
    if (making) madeWith = "";
  };
}

async function make(mine) {
  if (mine.aborted) return;
  const base = untracked(() => simulationRequest(patch.value, { duration_s: LIVE_S }));
  const take = ({ table }) => table.done && (_map.value = { ct: LEVELS, ta: LEVELS, fo: pitches(table) });
  making = true;
  try {
    await runSweep({ base, axes: AXES, measures: ["fo_hz"] }, take, mine);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    _map.value = null; // the pad works without a map; the refused setting shows why
  } finally {
    making = false;
  }
}

const pitches = ({ states, measures }) => measures.fo_hz.map((value, k) => (states[k] === "periodic" ? value : null));

const otherSettings = (of) =>
  patchText(
    of,
    AXES.flatMap(({ paths }) => paths),
  );
