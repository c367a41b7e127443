/** Texts of the controls. */

export const GROUPS = {
  muscles: "Muscles",
  voice: "Breath and tract",
  advanced: "Advanced",
  tied: "Move LCA and IA together",
};

/** What each muscle does, in the width of a slider; the long form comes with the schema. */
export const ROLES = {
  "activation.ta": "shortens and bulges the folds",
  "activation.ct": "stretches the folds: the pitch muscle",
  "activation.lca": "closes the membranous glottis",
  "activation.ia": "closes the back of the glottis",
  "activation.pca": "draws the folds apart: the only opener",
};

export const CONTROL = {
  typed: (name) => `${name}, typed value`,
  reset: (value) => `Double-click: back to ${value}`,
  ownChoice: "the variant’s own",
  automatic: "automatic",
  withoutPart: { posture: "by the muscles" },
  notGiven: "not given",
  allowed: (allowed) => `Allowed: ${allowed}.`,
};

export const VARIANT_NAMES = {
  paper: "Paper",
  text_literal: "Text to the letter",
  human: "Human: man",
  human_female: "Human: woman, extrapolated",
};

export const OPTION_NAMES = {
  true: "yes",
  false: "no",
  flat: "flat",
  static: "static shape",
  one_way: "one way",
  two_way: "two ways",
  inferior_stiff: "stiff at the inferior edge",
  superior_stiff: "stiff at the superior edge",
  kelvin_voigt: "Kelvin–Voigt",
  rotation: "rotation equation",
  serry2026: "Serry 2026",
  alzamendi2020: "Alzamendi 2020",
  titze2006: "Titze 2006",
  palaparthi2019: "Palaparthi 2019",
};
