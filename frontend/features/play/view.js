/**
 * The larynx as an instrument: start, move, listen; a pad for CT and TA, pictures of the present sound, and a
 * recording.
 */
import { html, signal, useComputed, useEffect, useRef } from "../../core/ui.js";
import { call, link } from "../../core/api.js";
import { numberText, steadyLimits } from "../../core/axis.js";
import { download } from "../../core/export.js";
import { Picture } from "../../core/picture.js";
import { palette, rootPx, smallFont } from "../../core/theme.js";
import { Icon } from "../../core/widgets.js";
import { buffer, now, problem, recorded, recordingS, status } from "../../state/played-voice.js";
import { setValue, values } from "../../state/request.js";
import { showNotice } from "../../state/session.js";
import { hasMidi, midi, toggleMidi } from "./midi.js";
import { followPad, padMap } from "./pad-map.js";
import { drawPad, drawScroll, drawSpectrum, drawTrace, padLayout } from "./paint.js";
import { canPlay, isOn, setRecording, soundGraph, startPlaying, stopPlaying } from "./player.js";
import { PLAY } from "./texts.js";

const CT = "activation.ct";
const TA = "activation.ta";
const STEP = 0.01;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export function Play() {
  useEffect(followPad, []);
  return html`
    <div class="play">
      <div class="play-head">
        <button
          type="button"
          class="listen"
          aria-pressed=${isOn()}
          disabled=${!canPlay()}
          title=${`${PLAY.start} (P)`}
          onClick=${() => (isOn() ? stopPlaying() : startPlaying())}
        >
          <${Icon} name=${isOn() ? "stop" : "play"} />
          <span>${isOn() ? PLAY.stop : PLAY.start}</span>
        </button>
        <${Record} />
        ${
          hasMidi &&
          html`
            <button type="button" class="quiet" aria-pressed=${midi.value} title=${PLAY.midiHelp} onClick=${toggleMidi}>
              <span>${PLAY.midi}</span>
            </button>
          `
        }
      </div>
      <div class="play-line">
        <${RecordedFiles} />
        <${Now} />
      </div>
      <p class="play-note" role="status">${problem.value || (canPlay() ? PLAY.about : PLAY.needsTls)}</p>
      <${Pad} />
      <div class="play-pictures">
        <${Picture} name="play-waves" label=${PLAY.waves} model=${scrollModel} paint=${drawScroll} />
        <${Picture} name="play-trace" label=${PLAY.trace} model=${traceModel} paint=${drawTrace} />
        <${Picture} name="play-spectrum" label=${PLAY.spectrumPicture} model=${spectrumModel} paint=${drawSpectrum} />
      </div>
    </div>
  `;
}

const look = () => ({ texts: PLAY, colours: palette.value, font: smallFont(), rem: rootPx() });

let scrollLimits = [];

function scrollModel() {
  const scroll = now.value?.scroll;
  if (!scroll) return null;
  scrollLimits = [scroll.area, scroll.flow].map((wave, k) =>
    steadyLimits(scrollLimits[k], { min: 0, max: Math.max(...wave) }, { least: [10, 500][k] }),
  );
  return { scroll, limits: scrollLimits, ...look() };
}

const TRACE_LIMITS = [
  [80, 240],
  [90, 150],
]; // Hz, dB at the lips: the model's whole range, so that the axes never move

function traceModel() {
  const frame = now.value;
  return frame && { trace: frame.trace, seconds: frame.traceSeconds, limits: TRACE_LIMITS, ...look() };
}

function spectrumModel() {
  const graph = now.value && soundGraph();
  if (!graph) return null;
  const bins = new Float32Array(graph.analyser.frequencyBinCount);
  graph.analyser.getFloatFrequencyData(bins);
  return { bins, hzPerBin: graph.context.sampleRate / graph.analyser.fftSize, ...look() };
}

const padModel = () => ({
  ct: values.value[CT],
  ta: values.value[TA],
  map: padMap.value,
  fo: now.value?.fo_hz,
  ...look(),
});

function Now() {
  const text = useComputed(() => {
    const frame = now.value;
    if (status.value === "off") return "";
    if (!frame) return PLAY.starting;
    const gaps = buffer.value?.gaps ? ` · ${PLAY.gaps(buffer.value.gaps)}` : "";
    return frame.fo_hz === null
      ? PLAY.silent + gaps
      : `${numberText(frame.fo_hz, 1)} Hz · ${numberText(frame.spl_lips_db, 1)} dB${gaps}`;
  });
  return html`
    <span class="play-now">${text}</span>
  `;
}

/** CT to the right, TA up: drag, or use the arrow keys on the focused pad (Shift: ten steps). */
function Pad() {
  const place = useRef(null);
  const move = (event) => {
    const canvas = place.current.querySelector("canvas");
    const area = canvas.getBoundingClientRect();
    const { ct, ta } = padLayout(area, rootPx()).fromPoint(event.clientX - area.left, event.clientY - area.top);
    put(ct, ta);
  };
  const down = (event) => {
    event.currentTarget.setPointerCapture(event.pointerId);
    move(event);
  };
  const key = (event) => {
    const way = ARROWS[event.key];
    if (!way) return;
    event.preventDefault();
    const step = STEP * (event.shiftKey ? 10 : 1);
    put(values.peek()[CT] + way[0] * step, values.peek()[TA] + way[1] * step);
  };
  const padValue = useComputed(() => PLAY.padValue(values.value[CT], values.value[TA]));
  return html`
    <div
      class="play-pad"
      ref=${place}
      tabindex="0"
      role="application"
      aria-label=${PLAY.pad}
      aria-description=${padValue}
      onPointerDown=${down}
      onPointerMove=${(event) => event.buttons && move(event)}
      onKeyDown=${key}
    >
      <${Picture} name="play-pad" model=${padModel} paint=${drawPad} />
    </div>
  `;
}

const rounded = (value) => Math.round(Math.max(0, Math.min(1, value)) / STEP) * STEP;

function put(ct, ta) {
  setValue(CT, Number(rounded(ct).toFixed(2)));
  setValue(TA, Number(rounded(ta).toFixed(2)));
}

const rendering = signal(false);

function Record() {
  const on = recordingS.value !== null;
  return html`
    <button
      type="button"
      class="quiet"
      aria-pressed=${on}
      disabled=${status.value !== "on"}
      title=${PLAY.recordHelp}
      onClick=${() => setRecording(!on)}
    >
      <${Icon} name=${on ? "stop" : "record"} />
      <span>${on ? PLAY.recording(recordingS.value) : PLAY.record}</span>
    </button>
  `;
}

/** The recorded files. Their line is always there, so that nothing moves. */
function RecordedFiles() {
  if (!recorded.value || recordingS.value !== null) return null;
  return html`
    <button type="button" class="quiet" disabled=${rendering.value} onClick=${() => saveRecording("wav")}>
      <${Icon} name="save" />
      <span>${PLAY.saveSound}</span>
    </button>
    <button type="button" class="quiet" onClick=${() => saveRecording("json")}>
      <${Icon} name="save" />
      <span>${PLAY.saveGesture}</span>
    </button>
  `;
}

/** The server renders the sound again from the gesture: the same samples as before. */
async function saveRecording(kind) {
  const body = recorded.value;
  if (kind === "json") return download("vocalis-gesture.json", JSON.stringify(body, null, 1), "application/json");
  rendering.value = true;
  try {
    const answer = await call("gestures", { method: "POST", body });
    const { links } = await answer.json();
    download("vocalis-gesture.wav", await (await call(link(links.audio), { accept: "audio/wav" })).blob());
  } catch (error) {
    showNotice(error.message);
  } finally {
    rendering.value = false;
  }
}
