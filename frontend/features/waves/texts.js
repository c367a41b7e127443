/** Texts of the waves. */

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

export const DETAIL = {
  title: "The whole run",
  titleOfEnd: "The last half second of the run",
  time: "time (s)",
  loading: "Loading the plot",
  failed: "The plot could not be loaded.",
};
