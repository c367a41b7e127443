/** Texts of the medial surface. */

export const SURFACE = {
  aero: "Aerodynamic pressure",
  contact: "Contact pressure",
  anterior: "anterior",
  posterior: "posterior",
  superior: "superior",
  inferior: "inferior",
  where: "Medial surface of one fold",
  atEnd: "in the last 10 ms of the run",
  at: (percent) => `at ${percent} % of the cycle`,
};
