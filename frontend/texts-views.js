/** Words of the deeper views: voice, folds, comparison, history, lessons, files and report. */

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
  span: (db) => `${db} dB below the loudest, pale to dark`,
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
  mode: { both: "Overlaid", difference: "Difference" },
  modeName: "How the waves are compared",
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
  pythonHelp: "Runs where Vocalis is installed: pip install vocalis, or the environment this server runs in.",
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
  usual: "Usual",
  comparison: "Compared with A",
  notes: "Notes",
  notesHelp: "Kept in this browser only. Write nothing about a patient.",
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
  minutes: (n) => `${n} steps`,
  failed: "The lessons could not be loaded.",
  loading: "Loading the lessons",
};

export const COPY_TABLE = { copy: "Copy as table", columns: ["Measure", "Symbol", "Value", "Unit", "Published range", "Source", "Definition", "Why there is no value"], copied: "Copied: paste it into a sheet or a document.", failed: "This browser does not let the page copy." };

export const STROBE = { name: "Strobe", locked: (hz) => `Strobe, ${hz} Hz`, slow: "Slow motion" };
