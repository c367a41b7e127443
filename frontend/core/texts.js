/** Texts that several features share. */

export const APP = {
  name: "Vocalis",
  use: "Adult male larynx; research and teaching, not a medical device.",
  unencryptedShort: "Live sound needs TLS here.",
  unencrypted:
    "Without encryption browsers keep live sound and the clipboard from a page. On the server, --tls-cert and --tls-key turn it on.",
  starting: "Preparing the model",
  startingWhy: "The first start compiles the equations for this machine: some ten seconds, once.",
  offline: "The server does not answer. Trying again…",
  waiting: "Waiting for the first result",
  controls: "Controls",
};

export const DIALOG = { close: "Close" };

export const PLOT = { failed: "The plot library could not be loaded." };

/** What went wrong between page and server. */
export const API = {
  noAnswer: "No answer",
  silent: "The server does not answer.",
  noEvents: "The server sends no events.",
};

export const STATES = {
  none: "No sustained vibration",
  periodic: "Periodic phonation",
  subharmonic: "Subharmonic phonation",
  irregular: "Irregular phonation",
};
