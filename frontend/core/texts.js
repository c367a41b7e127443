/** Texts that several features share. */

export const APP = {
  name: "Vocalis",
  use: "Adult larynx; research and teaching, not a medical device.",
  unencryptedShort: "Live sound needs TLS here.",
  unencrypted:
    "Browsers block live sound and the clipboard on pages without HTTPS. --tls-cert and --tls-key turn it on.",
  starting: "Preparing the model",
  startingWhy: "The first start compiles the equations for this machine, once. It takes about ten seconds.",
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
