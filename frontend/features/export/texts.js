/** Texts of the export. */

export const EXPORT = {
  title: "Export and share",
  report: "Report to print",
  code: "As Python or curl",
  figures: "Pictures on the page",
  data: "Data of this run",
  svg: "SVG",
  png: "PNG",
  wav: "Sound (WAV)",
  netcdf: "All arrays (netCDF)",
  csv: "Measures (CSV)",
  waves: "Waves (CSV)",
  figure: (title, kind) => `${title} as ${kind}`,
  open: "Export",
  openHelp: "Report, pictures, data, code",
};

export const CODE = {
  title: "This voice as code",
  python: "Python",
  pythonHelp: "Runs where Vocalis is installed, such as the environment this server runs in.",
  curl: "curl",
  curlHelp: 'Asks this server. If it wants a token, add -H "Authorization: Bearer TOKEN".',
  copy: "Copy",
  copied: "Copied.",
  copyFailed: "Select the text and copy it.",
};
