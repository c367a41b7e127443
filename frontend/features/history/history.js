/** The voices of this visit in order, for undo and redo. A voice is added once the user stops moving controls. */
import { batch, computed, effect, signal, untracked } from "../../core/ui.js";
import { patchText } from "../../core/parameters.js";
import { patch, restorePatch } from "../../state/request.js";
import { settled } from "../../state/settled.js";

const MOST = 60;

const _past = signal({ entries: [], at: -1 });

/** [{patch, state, pitch}], oldest first. */
export const entries = computed(() => _past.value.entries);
/** The place of the present one. */
export const at = computed(() => _past.value.at);
export const canUndo = computed(() => _past.value.at > 0);
export const canRedo = computed(() => _past.value.at < _past.value.entries.length - 1);

const same = (a, b) => patchText(a) === patchText(b);

/** The history with `entry` added: undone entries are dropped, and the oldest ones beyond MOST. Pure. */
export function remember({ entries: known, at: place }, entry) {
  if (known[place] && same(known[place].patch, entry.patch)) return { entries: known.with(place, entry), at: place };
  const next = [...known.slice(0, place + 1), entry].slice(-MOST);
  return { entries: next, at: next.length - 1 };
}

/** Starts recording; returns a function that stops it. */
export function followHistory() {
  return effect(() => {
    const shown = settled.value;
    if (!shown) return;
    untracked(() => {
      const entry = { patch: patch.peek(), state: shown.state, pitch: shown.measures.fo_hz.value };
      _past.value = remember(_past.peek(), entry);
    });
  });
}

/** Show entry `place` again. */
export function goTo(place) {
  const entry = _past.peek().entries[place];
  if (!entry) return;
  batch(() => {
    _past.value = { ..._past.peek(), at: place };
    restorePatch(entry.patch);
  });
}

export const undo = () => goTo(_past.peek().at - 1);
export const redo = () => goTo(_past.peek().at + 1);
