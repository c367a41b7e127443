/** MIDI controllers as sliders, where the browser supports MIDI and the user turns it on. */
import { readonly, signal } from "../../core/ui.js";
import { Disposal } from "../../core/dispose.js";
import { musclePaths, setValue } from "../../state/request.js";
import { showNotice } from "../../state/session.js";
import { PLAY } from "./texts.js";

const CONTROL_CHANGE = 0xb0;
const FIRST_CONTROLLER = 1; // modulation wheel and the knobs after it: TA, CT, LCA, IA, PCA

const _midi = signal(false);
const disposal = new Disposal();

export const hasMidi = typeof navigator.requestMIDIAccess === "function";
/** Whether controllers move the muscles. */
export const midi = readonly(_midi);

export async function toggleMidi() {
  if (_midi.value) {
    disposal.dispose();
    _midi.value = false;
    return;
  }
  try {
    const access = await navigator.requestMIDIAccess();
    for (const input of access.inputs.values()) disposal.listen(input, "midimessage", onMessage);
    _midi.value = true;
    if (!access.inputs.size) showNotice(PLAY.noMidi);
  } catch {
    showNotice(PLAY.midiRefused);
  }
}

function onMessage({ data: [kind, controller, value] }) {
  const path = (kind & 0xf0) === CONTROL_CHANGE ? musclePaths()[controller - FIRST_CONTROLLER] : undefined;
  if (path) setValue(path, Number((value / 127).toFixed(2)));
}
