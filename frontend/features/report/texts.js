/** Texts of the report. */

export const REPORT = {
  title: "Report",
  print: "Print",
  head: "Vocalis: a simulated voice",
  measures: "Measures",
  usual: "Published range",
  published: (range, source) => `${range}; ${source}`,
  notes: "Notes",
  notesHelp: "Notes stay in this browser only. Write nothing about a patient.",
  stage: "Glottis from above",
  waves: "Waves",
  milliseconds: "time in ms",
  made: (model, code, when) => `Model ${model}, Vocalis ${code}, ${when}.`,
  again: "Opens this voice again:",
};
