/** Texts for screen readers. */

/** For screen readers. */
export const SPEECH = {
  pitch: (hz) => `${hz} hertz`,
  level: (db) => `${db} decibels at 30 centimetres`,
};
