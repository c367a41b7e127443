/** The voice that is played live: whether it sounds, its present state, and the last recording. */
import { batch, readonly, signal } from "../core/ui.js";

const SCROLL_S = 0.5;
const TRACE_S = 12;

const _status = signal("off"); // off | starting | on
const _now = signal(null);
const _problem = signal("");
const _buffer = signal(null);
const _recordingS = signal(null);
const _recorded = signal(null);

export const status = readonly(_status);
/** The newest state frame, with `scroll` {area, flow, rate} and `trace` [{timeS, fo, level}] of the last seconds. */
export const now = readonly(_now);
export const problem = readonly(_problem);
/** {bufferMs, wantedMs, gaps, played} of the player. */
export const buffer = readonly(_buffer);
/** Recorded seconds; null when not recording. */
export const recordingS = readonly(_recordingS);
/** The last recorded gesture: a request document. */
export const recorded = readonly(_recorded);

let area = [];
let flow = [];
let trace = [];

export function setStatus(value) {
  batch(() => {
    _status.value = value;
    if (value === "off") [_recordingS.value, _now.value, _buffer.value] = [null, null, null];
    if (value === "starting") {
      _problem.value = "";
      [area, flow, trace] = [[], [], []];
    }
  });
}

export function takeState(frame) {
  const most = Math.round(SCROLL_S * frame.wave_rate_hz);
  area = area.concat(frame.area_mm2).slice(-most);
  flow = flow.concat(frame.flow_ml_s).slice(-most);
  const since = frame.time_s - TRACE_S;
  if (trace.length && trace[trace.length - 1].timeS > frame.time_s) trace = []; // a recording began: time starts again
  trace = [
    ...trace.filter(({ timeS }) => timeS > since),
    { timeS: frame.time_s, fo: frame.fo_hz, level: frame.spl_lips_db },
  ];
  batch(() => {
    _status.value = "on";
    _now.value = {
      ...frame,
      scroll: { area, flow, rate: frame.wave_rate_hz, seconds: SCROLL_S },
      trace,
      traceSeconds: TRACE_S,
    };
    _recordingS.value = frame.recording_s;
  });
}

export function takeBuffer(report) {
  _buffer.value = report;
}

export function takePlayProblem(text) {
  _problem.value = text;
}

export function takeGesture(gesture) {
  _recorded.value = gesture;
}
