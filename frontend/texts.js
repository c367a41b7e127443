/** Every word of the page that the server does not send. Longer than other files because it is a table of sentences. */

export const APP = {
  name: "Vocalis",
  use: "Adult male larynx; research and teaching, not a medical device.",
  unencryptedShort: "Live sound needs TLS here.",
  unencrypted: "Without encryption browsers keep live sound and the clipboard from a page. On the server, --tls-cert and --tls-key turn it on.",
  starting: "Preparing the model",
  startingWhy: "The first start compiles the equations for this machine: some ten seconds, once.",
  offline: "The server does not answer. Trying again…",
  waiting: "Waiting for the first result",
};

export const TOP = {
  preset: "Voice",
  own: "Own settings",
  variant: "Model",
  paper: "Paper",
  instrument: "Instrument",
  share: "Copy link",
  shared: "Link copied: it opens this voice.",
  sharedFailed: "The browser refused to copy; the link is in the address bar.",
  unknown: (names) => `The link names what is no parameter here: ${names.join(", ")}.`,
  toDark: "Dark theme",
  toLight: "Light theme",
  help: "Keys and help",
};

export const VARIANT_NAMES = {
  paper: "Paper",
  text_literal: "Text to the letter",
  human: "Human: man",
  human_female: "Human: woman, extrapolated",
};

export const GROUPS = {
  muscles: "Muscles",
  voice: "Breath and tract",
  advanced: "Advanced",
  tied: "Move LCA and IA together",
};

/** What each muscle does, in the width of a slider; the long form comes with the schema. */
export const ROLES = {
  "activation.ta": "shortens and bulges the folds",
  "activation.ct": "stretches the folds: the pitch muscle",
  "activation.lca": "closes the membranous glottis",
  "activation.ia": "closes the back of the glottis",
  "activation.pca": "draws the folds apart: the only opener",
};

export const OPTION_NAMES = {
  flat: "flat",
  static: "static shape",
  inferior_stiff: "stiff at the inferior edge",
  superior_stiff: "stiff at the superior edge",
  kelvin_voigt: "Kelvin–Voigt",
  rotation: "rotation equation",
  serry2026: "Serry 2026",
  alzamendi2020: "Alzamendi 2020",
  titze2006: "Titze 2006",
  palaparthi2019: "Palaparthi 2019",
};

export const CONTROL = {
  typed: (name) => `${name}, typed value`,
  reset: (value) => `Double-click: back to ${value}`,
  ownChoice: "the variant’s own",
  automatic: "automatic",
  byMuscles: "by the muscles",
  allowed: (allowed) => `Allowed: ${allowed}.`,
};

export const STAGE = {
  title: "Glottis from above",
  anterior: "Anterior",
  posterior: "Posterior",
  anteriorLeft: "Anterior left",
  endoscope: "Endoscope",
  orientation: "Orientation of the view",
  muscles: "Muscles",
  play: "Play the motion",
  pause: "Stop the motion",
  phase: "Phase of the cycle",
  speed: "Speed",
  speedOf: (n) => `1/${n} speed`,
  strain: "Strain",
  angle: "Half-angle",
  length: "Length",
  atRest: "At rest",
  legend: { superior: "superior edge", inferior: "inferior edge", ghost: "at rest, no pressure", opening: "opening", contact: "contact" },
  picture: "Both vocal folds seen from above, anterior commissure to vocal processes",
};

export const CLOSURE = {
  complete: "closed along the whole length",
  posterior_opening: "open at the back",
  anterior_opening: "open in front",
  hourglass: "hourglass: touching in the middle",
  spindle: "spindle: open in the middle",
  open: "open along the whole length",
};

export const MAPS = {
  aero: "Aerodynamic pressure",
  contact: "Contact pressure",
  anterior: "anterior",
  posterior: "posterior",
  superior: "superior",
  inferior: "inferior",
  where: "Medial surface of one fold",
  atEnd: "in the last 10 ms of the run",
  at: (percent) => `at ${percent} % of the cycle`,
};

export const WAVES = {
  pressure: "Radiated pressure at the lips",
  flow: "Glottal flow",
  slope: "Flow derivative",
  area: "Glottal area",
  contact: "Contact pressure, largest",
  stack: "Waves of the voice",
  time: "ms from the start of the highlighted cycle",
  timeFree: "ms, last part of the run",
  zoom: "Zoom",
  zoomHelp: "Open the whole run, to zoom and measure",
  picture: "Waves over time, one above the other; drag to move the cursor",
};

export const SHAPES = {
  title: "Shape of one fold",
  open: "most open",
  closed: "most closed",
  static: "at rest",
  edges: "superior solid, inferior dashed",
  medial: "midline",
  axis: "mm from midline",
  along: "mm from the anterior commissure",
  picture: "Distance of the fold’s edges from the midline along its length: static, most open, most closed",
};

export const PANELS = {
  waves: "Waves", voice: "Spectrum", folds: "Folds", compare: "A / B", measures: "Measures", map: "Map", play: "Play", lessons: "Lessons", run: "Runs",
}; // prettier-ignore
export const TABS = { muscles: "Muscles", play: "Play", waves: "Waves", numbers: "Numbers", map: "Map", more: "More" };

export const STATES = {
  none: "No sustained vibration",
  periodic: "Periodic phonation",
  subharmonic: "Subharmonic phonation",
  irregular: "Irregular phonation",
};

/** Large numbers of the strip: measure, label, unit as shown, factor. */
export const HEADLINES = [
  { key: "fo_hz", label: "Pitch" },
  { key: "spl_30cm_db", label: "Level at 30 cm", also: { key: "spl_lips_db", label: "lips" } },
  { key: "closed_quotient", label: "Closed quotient", decimals: 2 },
  { key: "speed_quotient", label: "Speed quotient" },
  { key: "mean_flow_ml_s", label: "Mean flow" },
  { key: "contact_pressure_max_pa", label: "Contact", unit: "kPa", factor: 1e-3, decimals: 2 },
];

export const MEASURE = {
  definition: "Definition",
  formula: "Formula",
  threshold: "Settings",
  signal: "Read from",
  normal: "Expected",
  source: "Source",
  noRange: "No published range for this measure.",
  cycles: (n) => (n ? `Mean over ${n} cycles of the last half of the run.` : "From the last half of the run."),
  caution: "This model’s absolute flow and level lie well above a human’s; read trends and shapes.",
  open: (name) => `${name}: definition, expected values, source`,
  table: "All measures",
};

export const SOUND = {
  play: "Listen",
  pause: "Stop",
  volume: "Volume",
  loop: "Repeat",
  loopHelp: "Repeat whole cycles without end; off: the run once, from its onset",
  saveHelp: "Download the sound of this run, 48 kHz",
};

export const PLAY = {
  start: "Play live",
  stop: "Stop",
  about: "Hear the voice change under your hand: drag a muscle, the breath, or the point on the pad. Shading: pitch.",
  needsTls: "Live sound needs a secure page: open it on localhost, or have the server started with --tls-cert and --tls-key.",
  starting: "Starting the voice…",
  silent: "no voice",
  gaps: (n) => `${n} gap${n === 1 ? "" : "s"}`,
  gone: "The voice ended: the server does not answer.",
  ended: (reason) => `The voice ended: ${reason}.`,
  failed: (why) => `The voice could not start: ${why}`,
  area: "Glottal area",
  flow: "Glottal flow",
  fo: "Pitch",
  level: "Level at the lips",
  spectrum: "Spectrum of the sound",
  ct: "Cricothyroid (CT)",
  ta: "Thyroarytenoid (TA)",
  pad: "Pad: cricothyroid to the right, thyroarytenoid up. Arrow keys move by 0.01, with Shift by 0.1.",
  padValue: (ct, ta) => `CT ${ct.toFixed(2)}, TA ${ta.toFixed(2)}`,
  waves: "Glottal area and flow of the last half second",
  trace: "Pitch and level of the last twelve seconds",
  spectrumPicture: "Spectrum of what sounds, up to 5 kHz",
  record: "Record",
  recordHelp: "Begin again from rest and keep every movement of the hand",
  recording: (s) => `Recording ${s.toFixed(1)} s`,
  saveSound: "Sound",
  saveGesture: "Gesture",
  midi: "MIDI",
  midiHelp: "Controllers 1 to 5 move TA, CT, LCA, IA and PCA",
  noMidi: "No MIDI controller is connected.",
  midiRefused: "The browser does not allow MIDI here.",
};

export const RUN = {
  title: "A longer run",
  about: "The present settings over up to ten seconds, worked on in the background: onset, slow change, a file to keep.",
  duration: "Duration",
  start: "Run",
  cancel: "Cancel",
  show: "Show here",
  shown: (s) => `Shown: the end of the run of ${s.toFixed(1)} s. The next change goes back to live.`,
  files: "Files",
  wav: "Sound (WAV)",
  netcdf: "All arrays (netCDF)",
  csv: "Measures (CSV)",
  failed: "The run failed.",
  statuses: {
    accepted: "Waiting for its turn",
    running: "Running",
    successful: "Finished",
    failed: "Failed",
    dismissed: "Cancelled",
  },
};

export const LOGIN = {
  title: "This server asks for its token",
  about: "Whoever started the server finds it in the line it printed.",
  token: "Token",
  enter: "Enter",
  wrong: "That is not the token.",
};

export const HELP = {
  title: "Keys and help",
  close: "Close",
  keys: [
    ["Space", "sound on or off"],
    ["P", "play live: the voice changes under the hand; again stops it"],
    ["1 – 5", "choose a muscle: TA, CT, LCA, IA, PCA"],
    ["← →", "move the chosen slider by its step (muscles 0.01)"],
    ["Shift ← →", "ten steps (muscles 0.1)"],
    ["A  B", "hold the voice as A, as B; B again lets it go"],
    ["Ctrl Z", "undo; with Shift redo"],
    ["M", "motion on or off"],
    ["[  ]", "one step back or on in the cycle"],
    ["?", "this page"],
  ],
  howTitle: "How to read the page",
  how: [
    "Left is the cause: five muscles, breath, tract. The middle is the body: the folds take posture and vibrate. Right and below is the consequence: waves, numbers, sound.",
    "Everything follows the hand. The dotted line on the stage is where the folds would rest without air.",
    "Point at a wave to look at that moment: stage and pressure maps follow. The shaded stretch is the cycle they show.",
    "Tap a number for its definition, expected values and source.",
  ],
};

export const DETAIL = { title: "The whole run", titleOfEnd: "The last half second of the run", time: "time (s)", loading: "Loading the plot", failed: "The plot could not be loaded." };

/** What would help when nothing vibrates, from the values set and the gap between the vocal processes, mm. */
export function hintFor(values, gapMm) {
  const pressure = values.subglottal_pressure_pa;
  const apart = gapMm > 1;
  const advice = [];
  if (apart && values["activation.pca"] > 0.05) advice.push("less PCA");
  if (apart && Math.min(values["activation.lca"], values["activation.ia"]) < 0.6) advice.push("more LCA and IA");
  if (pressure < 600) advice.push("more lung pressure");
  if (!apart && values["activation.ta"] > 0.6) advice.push("less TA");
  if (!apart && values["activation.ct"] > 0.7) advice.push("less CT");
  if (!advice.length) advice.push(apart ? "a posture closer to the midline" : "another lung pressure");
  const cause = apart ? `The vocal processes stand ${gapMm.toFixed(1)} mm apart. ` : "";
  return `${cause}Try ${advice.join(", ").replace(/, ([^,]*)$/, " or $1")}.`;
}
