/** Texts of the longer run. */

export const RUN = {
  title: "A longer run",
  about: "Runs the present settings for up to ten seconds in the background: onset, slow change, a file to keep.",
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
