/** Texts around the lessons, which are data themselves. */

export const LESSONS = {
  title: "Lessons",
  about: "Eight short lessons on the live model. Each step sets the voice. Watch what changes.",
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
