/** Texts of spectrum and tract. */

export const SPECTRUM = {
  spectrum: "Spectrum of the sound",
  spectrumPicture: "Level over frequency with the harmonics of the voice and the resonances of the vocal tract",
  spectrogram: "Spectrogram of the run",
  spectrogramPicture: "Level over time and frequency, from the onset to the end of the run",
  tract: "Area of the vocal tract",
  tractPicture: "Cross-section of the vocal tract from the glottis to the lips",
  level: "dB SPL",
  hertz: "frequency (kHz)",
  area: "cm²",
  along: "cm from the glottis",
  seconds: "time (s)",
  kilohertz: "kHz",
  lips: "lips",
  keys: { harmonics: "harmonics", gain: "gain of the tract", formants: "its resonances" },
  formantsTitle: "Resonances, Hz",
  span: (db) => [`−${db}`, "0 dB, the loudest"],
};
