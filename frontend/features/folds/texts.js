/** Texts of the folds. */

export const SHAPES = {
  title: "Shape of one fold",
  open: "most open",
  closed: "most closed",
  static: "at rest",
  edges: "superior solid, inferior dashed",
  medial: "midline",
  axis: "mm from midline",
  along: "mm from the anterior commissure",
  picture: "Distance of the fold’s edges from the midline along its length: static, most open, most closed",
};

export const FOLDS = {
  kymogram: "Kymogram",
  kymogramPicture: "Both folds along one line across the glottis, over two cycles",
  vibrogram: "Glottovibrogram",
  vibrogramPicture: "Width of the glottis along its length, over two cycles",
  level: "Across the glottis at",
  levelHelp: "share of the length, from the anterior commissure",
  lateral: "mm from midline",
  along: "x/L, anterior 0",
  cycles: "cycles",
  free: "last 10 ms, shown twice",
  width: "mm wide",
  nothing: "Nothing vibrates: there is no cycle to show.",
  drag: "Drag across a picture to move through the cycle.",
  strip: {
    title: "Six moments of the cycle",
    picture: "Glottis from above, aerodynamic and contact pressure on the medial surface at six phases of the cycle",
    scales: "colours as in the maps",
    above: "above",
    aero: "air",
    contact: "contact",
    moment: (percent) => `${percent} %`,
    hold: (percent) => `Look at ${percent} % of the cycle`,
  },
};
