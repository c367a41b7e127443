/** Every word of the page that the server does not send; the lessons are data. Longer than other files because it is a table of sentences. */

export const APP = {
  name: "Vocalis",
  use: "Adult male larynx; research and teaching, not a medical device.",
  unencryptedShort: "Live sound needs TLS here.",
  unencrypted: "Without encryption browsers keep live sound and the clipboard from a page. On the server, --tls-cert and --tls-key turn it on.",
  starting: "Preparing the model",
  startingWhy: "The first start compiles the equations for this machine: some ten seconds, once.",
  offline: "The server does not answer. Trying again…",
  waiting: "Waiting for the first result",
  controls: "Controls",
};

/** What went wrong between page and server. */
export const API = {
  noAnswer: "No answer",
  silent: "The server does not answer.",
  noEvents: "The server sends no events.",
};

/** For screen readers. */
export const SPEECH = {
  pitch: (hz) => `${hz} hertz`,
  level: (db) => `${db} decibels at 30 centimetres`,
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
  one_way: "one way",
  two_way: "two ways",
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
  phaseWords: (percent) => `${percent} percent of the cycle`,
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
  about: (value) => `about ${value}`,
  fromTo: (low, high) => `${low} to ${high}`,
  usual: (range) => `usual ${range}`,
  source: "Source",
  noRange: "No published range for this measure.",
  cycles: (n) => (n ? `Mean over ${n} cycles of the last half of the run.` : "From the last half of the run."),
  caution: "With the paper’s constants absolute flow and level lie well above a human’s; read trends and shapes.",
  open: (name) => `${name}: definition, expected values, source`,
  table: "All measures",
  columns: ["Measure", "Value", "Published"],
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

// The deeper views: voice, folds, comparison, history, lessons, files, report.

export const VOICE = {
  spectrum: "Spectrum of the sound",
  spectrumPicture: "Level over frequency with the harmonics of the voice and the resonances of the vocal tract",
  spectrogram: "Spectrogram of the run",
  spectrogramPicture: "Level over time and frequency, from the onset to the end of the run",
  tract: "Area of the vocal tract",
  tractPicture: "Cross-section of the vocal tract from the glottis to the lips",
  level: "dB SPL",
  hertz: "frequency (kHz)",
  area: "cm²",
  along: "cm from the glottis",
  seconds: "time (s)",
  kilohertz: "kHz",
  glottis: "glottis",
  lips: "lips",
  keys: { harmonics: "harmonics", gain: "gain of the tract", formants: "its resonances" },
  formants: (list) => list.map((hz, k) => `R${k + 1} ${hz}`).join("   "),
  formantsTitle: "Resonances, Hz",
  span: (db) => [`−${db}`, "0 dB, the loudest"],
};

export const FOLDS = {
  kymogram: "Kymogram",
  kymogramPicture: "Both folds along one line across the glottis, over two cycles",
  vibrogram: "Glottovibrogram",
  vibrogramPicture: "Width of the glottis along its length, over two cycles",
  level: "Across the glottis at",
  levelHelp: "share of the length, from the anterior commissure",
  lateral: "mm from midline",
  along: "x/L, anterior 0",
  cycles: "cycles",
  free: "last 10 ms, shown twice",
  width: "mm wide",
  nothing: "Nothing vibrates: there is no cycle to show.",
  drag: "Drag across a picture to move through the cycle.",
  strip: {
    title: "Six moments of the cycle",
    picture: "Glottis from above, aerodynamic and contact pressure on the medial surface at six phases of the cycle",
    scales: "colours as in the maps",
    above: "above",
    aero: "air",
    contact: "contact",
    moment: (percent) => `${percent} %`,
    hold: (percent) => `Look at ${percent} % of the cycle`,
  },
};

export const COMPARE = {
  title: "Compare A and B",
  hold: { a: "Hold A", b: "Hold B" },
  holdHelp: { a: "Keep this voice as A (key A)", b: "Keep this voice as B (key B)" },
  held: { a: "A is held. Change something: B is what you see.", b: "B is held." },
  free: "B follows the hand",
  forget: "Forget both",
  live: "live",
  heldMark: "held",
  start: "Hold a voice as A, then change something. What you see is B until you hold that too.",
  hear: { a: "Hear A", b: "Hear B", turn: "In turn" },
  hearHelp: "at equal loudness",
  stop: "Stop",
  state: "State",
  sameSettings: "A and B have the same settings.",
  measure: "Measure",
  difference: "B − A",
  waves: "One cycle, from closing",
  picture: "Waves of A and B over one cycle, one above the other",
  difPicture: "B minus A",
  cycle: "share of the cycle",
  mode: { both: "Overlaid", difference: "Difference", folds: "Folds" },
  modeName: "What is compared",
  folds: (percent) => `At ${percent} % of each cycle`,
  foldsPicture: "Glottis from above, aerodynamic and contact pressure on the medial surface of A and B at the same phase, same limits",
  back: "Go back to A",
  none: "–",
  short: { min_flow_ml_s: "Minimum flow", mfdr_l_s2: "Flow declination", h1_h2_sound_db: "Harmonics, sound", gap_mm: "Posterior gap" },
};

export const HISTORY = {
  title: "This visit",
  undo: "Undo",
  redo: "Redo",
  empty: "Every voice you rest on is kept here until the page is closed.",
  first: "Start",
  several: (n) => `${n} settings`,
  now: "shown now",
};

export const KEEP = {
  title: "Keep and share",
  report: "Report to print",
  code: "As Python or curl",
  figures: "Pictures shown now",
  data: "Data of the run shown",
  svg: "SVG",
  png: "PNG",
  wav: "Sound (WAV)",
  netcdf: "All arrays (netCDF)",
  csv: "Measures (CSV)",
  waves: "Waves (CSV)",
  figure: (title, kind) => `${title} as ${kind}`,
  open: "Keep",
  openHelp: "Report, pictures, data, code",
};

export const CODE = {
  title: "This voice as code",
  python: "Python",
  pythonHelp: "Runs where Vocalis is installed, such as the environment this server runs in.",
  curl: "curl",
  curlHelp: "Asks this server. If it wants a token, add -H \"Authorization: Bearer TOKEN\".",
  copy: "Copy",
  copied: "Copied.",
  copyFailed: "Select the text and copy it.",
};

export const REPORT = {
  title: "Report",
  print: "Print",
  head: "Vocalis: a simulated voice",
  settings: "Settings",
  measures: "Measures",
  usual: "Published range",
  published: (range, source) => `${range}; ${source}`,
  comparison: "Compared with A",
  notes: "Notes",
  notesHelp: "Notes are kept in this browser only. Write nothing about a patient.",
  stage: "Glottis from above",
  waves: "Waves",
  milliseconds: "time in ms",
  made: (model, code, when) => `Model ${model}, Vocalis ${code}, ${when}.`,
  again: "Opens this voice again:",
};

export const LESSONS = {
  title: "Lessons",
  about: "Eight short lessons on the live model. Each step sets the voice; what changes is yours to look for.",
  start: "Start",
  step: (k, n) => `Step ${k} of ${n}`,
  next: "Next",
  back: "Back",
  all: "All lessons",
  done: "Finish",
  see: "See",
  numbers: "Measured now",
  minutes: (n) => `${n} steps`,
  failed: "The lessons could not be loaded.",
  loading: "Loading the lessons",
};

export const COPY_TABLE = { copy: "Copy as table", columns: ["Measure", "Symbol", "Value", "Unit", "Published range", "Source", "Definition", "Why there is no value"], copied: "Copied: paste it into a sheet or a document.", failed: "This browser does not let the page copy." };

export const STROBE = { name: "Strobe", locked: (hz) => `Strobe, ${hz} Hz`, slow: "Slow motion" };

// The map over two parameters.
export const MAP = {
  title: "Map over two parameters",
  directions: ["Up", "To the right"],
  parameter: (direction) => `${direction}: parameter`,
  from: (direction) => `${direction}: from`,
  to: (direction) => `${direction}: to`,
  stepsOf: (direction) => `${direction}: steps`,
  tied: "LCA and IA together",
  tiedShort: "LCA = IA",
  short: { from: "from", to: "to", steps: "steps" },
  start: "Make the map",
  again: "Make it anew",
  cancel: "Cancel",
  progress: (done, total) => `${done} of ${total}`,
  empty: "Each cell is a voice: the present settings with two of them changed. Choose the two, then make the map.",
  measure: "Measure",
  follow: "Follow the other sliders",
  followHelp: "Make the map anew when another setting has changed and rests",
  keep: "Keep as A",
  keepHelp: "Keep this map, to take it from later ones",
  difference: "B − A",
  differenceHelp: "Show this map minus the one kept as A",
  otherPoints: "A has other axes.",
  files: "Download",
  csv: "CSV",
  netcdf: "netCDF",
  picture: (name, up, right) => `${name} over ${up} and ${right}; a click on a cell loads its voice`,
  cells: "Cells",
  counted: (text, n) => `${text} (${n})`,
  voiced: (n, total) => `${n} of ${total} cells periodic`,
  states: {
    subharmonic: "subharmonic",
    irregular: "irregular",
    none: "no phonation",
    failed: "the run failed",
    unvalued: "periodic, but no value",
    current: "the voice set now",
  },
  pick: "Choose a cell",
  load: "Load this voice",
  waiting: "not computed yet",
  sameTwice: "The two parameters must differ.",
  steps: (most) => `Steps: whole numbers from 2 to ${most}.`,
  refused: ({ path, message, allowed }) => `${path}: ${message}${allowed ? ` Allowed: ${allowed}.` : ""}`,
};

// The Paper section.
export const PAPER = {
  title: "The paper, as this model draws it",
  source: "Serry, Zañartu & Peterson (2026)",
  sections: { static: "Static", modal: "Voices", maps: "Maps", pca: "PCA", scoreboard: "Scoreboard" },
  loading: "Loading the figures",
  notLoaded: (why) => `The figures could not be loaded: ${why}`,
  shipped: ({ model_version, code_version, created, variant }) => `Computed ${created.slice(0, 10)} by Vocalis ${code_version}, model ${model_version}, variant “${variant}”.`,
  here: ({ created, model_version, code_version }) => `Computed here ${created.slice(11, 16)} UTC, Vocalis ${code_version}, model ${model_version}`,
  again: "Compute again",
  cancel: "Cancel",
  back: "Back to shipped",
  progress: (done, total) => `${done} of ${total}`,
  open: "Open in the instrument",
  verdicts: { pass: "✓ pass", deviation: "≈ deviation", fail: "✗ fail" },
  claims: "What the paper claims, and what came out",
  says: "The paper",
  test: "The test",
  opensLevel: (name, level) => `${name} ${level}: open in the instrument`,
  hint: "A level opens its posture in the instrument.",
  series: {
    static_adduction: { name: "LCA = IA", fixed: "CT 0.1, TA 0, PCA 0" },
    static_ta: { name: "TA", fixed: "LCA = IA 0.5, CT 0.1, PCA 0" },
    static_ct: { name: "CT", fixed: "LCA = IA 0.5, TA 0.2, PCA 0" },
    static_pca: { name: "PCA", fixed: "LCA = IA 0.8, TA 0.5, CT 0.3" },
  },
  seriesPicture: (name) => `Static shape of one fold from above at rising ${name}; superior edge solid, inferior dashed`,
  edges: "Solid: superior edge; dashed: inferior edge.",
  voices: { modal: "Modal", pca_half: "PCA 0.5", pca_full: "PCA 1" },
  voicesLabel: "Which voice",
  waves: "Waves; the shaded cycle is the one shown on the right",
  shapes: "One fold: most open, most closed, at rest",
  matrix: "One cycle on the medial surface",
  matrixPicture: "Eight phases of one cycle, one a row: opening from above, aerodynamic and contact pressure on the medial surface",
  columns: { opening: "Opening, from above", aero: "Aerodynamic pressure", contact: "Contact pressure" },
  narrowColumns: { opening: "Opening", aero: "Air pressure", contact: "Contact" },
  reach: (mm) => `Openings to one scale, ${mm} mm from the midline at most. Left anterior; pressures: superior edge at the top.`,
  measures: {
    fo_hz: { name: "Fundamental frequency", unit: "Hz", decimals: 0, claims: ["A1", "A2", "A3", "A4", "A5"] },
    mean_flow_ml_s: { name: "Mean glottal flow", unit: "mL/s", decimals: 0, claims: ["A6"] },
    spl_lips_db: { name: "Sound pressure level at the lips", unit: "dB", decimals: 1, claims: ["A7"] },
    speed_quotient: { name: "Speed quotient", unit: "", decimals: 2, claims: ["A8"] },
    closed_quotient: { name: "Closed quotient", unit: "", decimals: 2, claims: ["A9"] },
  },
  axes: { "activation.ct": "CT", "activation.ta": "TA", "activation.pca": "PCA" },
  states: {
    subharmonic: "subharmonic: no single pitch",
    weak: "repeats, too weak for voice",
    irregular: "irregular",
    none: "no phonation",
    failed: "the run failed",
    current: "the posture set in the instrument",
  },
  noVoice: "Cells without a value",
  counted: (text, n) => `${text} (${n})`,
  mapFixed: "LCA = IA 0.6, PCA 0; a cell opens its voice in the instrument.",
  mapPicture: (name) => `${name} over CT and TA`,
  pick: "Choose a cell",
  pressure: "Largest contact pressure, mean over cycles",
  pressureUnit: "kPa",
  location: "Where it is largest, along the fold",
  locationUnit: "x/L (0 anterior, 1 posterior)",
  pcaFixed: "LCA = IA 0.8, CT 0.3, TA 0.4; a point opens its voice in the instrument.",
  pca: "PCA activation",
  plotFailed: "The plot library could not be loaded.",
  variants: { paper: "Paper", text_literal: "Text to the letter" },
  claim: "Claim",
  score: (n) => `${n.pass} pass · ${n.deviation} deviation · ${n.fail} fail`,
};
