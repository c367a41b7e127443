/** Texts of the sound. */

export const SOUND = {
  play: "Listen",
  pause: "Stop",
  volume: "Volume",
  loop: "Repeat",
  loopHelp: "Repeat whole cycles without end; off: the run once, from its onset",
  saveHelp: "Download the sound of this run, 48 kHz",
};
