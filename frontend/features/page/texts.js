/** Texts of the page as a whole: top bar, tabs, sign-in, help. */

export const TOP = {
  preset: "Voice",
  own: "Own settings",
  variant: "Model",
  paper: "Paper",
  instrument: "Instrument",
  share: "Copy link",
  shared: "Link copied: it opens this voice.",
  sharedFailed: "The browser refused to copy; the link is in the address bar.",
  unknown: (names) => `Unknown parameters in the link: ${names.join(", ")}.`,
  toDark: "Dark theme",
  toLight: "Light theme",
  help: "Keys and help",
};

export const PANELS = {
  waves: "Waves",
  voice: "Spectrum",
  folds: "Folds",
  compare: "A / B",
  measures: "Measures",
  map: "Map",
  play: "Play",
  lessons: "Lessons",
  run: "Runs",
};

export const TABS = { muscles: "Muscles", play: "Play", waves: "Waves", numbers: "Numbers", map: "Map", more: "More" };

export const LOGIN = {
  title: "This server asks for its token",
  about: "Whoever started the server finds it in the line it printed.",
  token: "Token",
  enter: "Enter",
  wrong: "That is not the token.",
};

export const HELP = {
  title: "Keys and help",
  keys: [
    ["Space", "sound on or off"],
    ["P", "play live: the voice follows your movements; P again stops it"],
    ["1 – 5", "choose a muscle: TA, CT, LCA, IA, PCA"],
    ["← →", "move the chosen slider by its step (muscles 0.01)"],
    ["Shift ← →", "ten steps (muscles 0.1)"],
    ["A  B", "hold the voice as A or as B; B again releases it"],
    ["Ctrl Z", "undo; with Shift redo"],
    ["M", "motion on or off"],
    ["[  ]", "one step back or forward in the cycle"],
    ["?", "this page"],
  ],
  howTitle: "How to read the page",
  how: [
    "The left shows the cause: five muscles, breath, tract. The middle shows the body: the folds take their posture " +
      "and vibrate. The right and the bottom show the consequence: waves, numbers, sound.",
    "Everything follows your movements at once. The dotted line on the stage shows the folds at rest, without air.",
    "Point at a wave to see that moment: stage and pressure maps follow. The shaded part is the cycle they show.",
    "Tap a number for its definition, expected values and source.",
  ],
};
