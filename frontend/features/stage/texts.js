/** Texts of the stage. */

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
  legend: {
    superior: "superior edge",
    inferior: "inferior edge",
    ghost: "at rest, no pressure",
    opening: "opening",
    contact: "contact",
  },
  foldsDiffer: "The folds differ; the picture shows the left one.",
  picture: "Both vocal folds seen from above, anterior commissure to vocal processes",
};

export const STROBE = { name: "Strobe", locked: (hz) => `Strobe, ${hz} Hz`, slow: "Slow motion" };

export const CLOSURE = {
  complete: "closed along the whole length",
  posterior_opening: "open at the back",
  anterior_opening: "open in front",
  hourglass: "hourglass: touching in the middle",
  spindle: "spindle: open in the middle",
  open: "open along the whole length",
};
