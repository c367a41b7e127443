/**
 * The part of a canvas context that the painters of this page use, written as SVG. The same painter makes the picture
 * on the page and the figure for a paper.
 */

const STATE = [
  "fillStyle",
  "strokeStyle",
  "lineWidth",
  "lineCap",
  "lineJoin",
  "globalAlpha",
  "font",
  "textAlign",
  "textBaseline",
];
const ANCHOR = { left: "start", start: "start", center: "middle", right: "end", end: "end" };
// In em: correct also in viewers that ignore dominant-baseline.
const BASELINE_EM = { top: 0.78, middle: 0.32, bottom: -0.22, alphabetic: 0 };

const round = (value) => Math.round(value * 100) / 100;
const escaped = (text) => String(text).replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);

const boxOf = (x, y, width, height) =>
  `x="${round(x)}" y="${round(y)}" width="${round(width)}" height="${round(height)}"`;

export class SvgContext {
  isFigure = true;
  #parts = [];
  #definitions = [];
  #path = "";
  #dash = [];
  #stack = [];
  #transform = "";
  #clip = "";

  fillStyle = "#000";
  strokeStyle = "#000";
  lineWidth = 1;
  lineCap = "butt";
  lineJoin = "miter";
  globalAlpha = 1;
  font = "12px sans-serif";
  textAlign = "start";
  textBaseline = "alphabetic";

  constructor(width, height, title) {
    this.canvas = { width, height };
    this.title = title;
  }

  /** The whole figure, on `ground`. */
  text(ground) {
    const { width, height } = this.canvas;
    const size = `width="${round(width)}" height="${round(height)}"`;
    return [
      `<svg xmlns="http://www.w3.org/2000/svg" ${size} viewBox="0 0 ${round(width)} ${round(height)}" role="img">`,
      `<title>${escaped(this.title)}</title>`,
      `<defs>${this.#definitions.join("")}</defs>`,
      `<rect width="100%" height="100%" fill="${ground}"/>`,
      ...this.#parts,
      "</svg>",
    ].join("\n");
  }

  save() {
    this.#stack.push({
      ...Object.fromEntries(STATE.map((key) => [key, this[key]])),
      dash: this.#dash,
      transform: this.#transform,
      clip: this.#clip,
    });
  }

  restore() {
    const { dash, transform, clip, ...state } = this.#stack.pop();
    Object.assign(this, state);
    this.#dash = dash;
    this.#transform = transform;
    this.#clip = clip;
  }

  translate(x, y) {
    this.#transform += `translate(${round(x)} ${round(y)})`;
  }

  rotate(angle) {
    this.#transform += `rotate(${round((angle * 180) / Math.PI)})`;
  }

  setLineDash(dash) {
    this.#dash = dash;
  }

  beginPath() {
    this.#path = "";
  }

  moveTo(x, y) {
    this.#path += `M${round(x)} ${round(y)}`;
  }

  lineTo(x, y) {
    this.#path += `${this.#path ? "L" : "M"}${round(x)} ${round(y)}`;
  }

  bezierCurveTo(...points) {
    this.#path += `C${points.map(round).join(" ")}`;
  }

  quadraticCurveTo(...points) {
    this.#path += `Q${points.map(round).join(" ")}`;
  }

  rect(x, y, width, height) {
    this.#path += `M${round(x)} ${round(y)}h${round(width)}v${round(height)}h${round(-width)}z`;
  }

  /** Whole circles only: the page draws no other arcs. */
  arc(x, y, radius) {
    const half = (across) => `a${radius} ${radius} 0 1 0 ${across} 0`;
    this.#path += `M${round(x - radius)} ${round(y)}${half(2 * radius)}${half(-2 * radius)}z`;
  }

  closePath() {
    this.#path += "z";
  }

  clip() {
    const id = `clip${this.#definitions.length}`;
    const inside = this.#clip ? ` clip-path="${this.#clip}"` : "";
    this.#definitions.push(`<clipPath id="${id}"><path d="${this.#path}"${inside}/></clipPath>`);
    this.#clip = `url(#${id})`;
  }

  fill() {
    this.#add(`<path d="${this.#path}" fill="${this.fillStyle}"`);
  }

  stroke() {
    this.#add(`<path d="${this.#path}" fill="none" ${this.#strokeWords()}`);
  }

  fillRect(x, y, width, height) {
    this.#add(`<rect ${boxOf(x, y, width, height)} fill="${this.fillStyle}"`);
  }

  fillText(text, x, y) {
    this.#write(text, x, y, `fill="${this.fillStyle}"`);
  }

  strokeText(text, x, y) {
    this.#write(text, x, y, `fill="none" ${this.#strokeWords()}`);
  }

  /** `image`: a canvas; embedded, stretched without smoothing away its cells. */
  drawImage(image, x, y, width, height) {
    this.#add(`<image ${boxOf(x, y, width, height)} preserveAspectRatio="none" href="${image.toDataURL()}"`);
  }

  #strokeWords() {
    const dash = this.#dash.length ? ` stroke-dasharray="${this.#dash.join(" ")}"` : "";
    const ends = `stroke-linecap="${this.lineCap}" stroke-linejoin="${this.lineJoin}"`;
    return `stroke="${this.strokeStyle}" stroke-width="${round(this.lineWidth)}" ${ends}${dash}`;
  }

  #write(text, x, y, paint) {
    const [, weight, size, family] = /^(?:(\w+) )?([\d.]+)px (.*)$/.exec(this.font);
    const down = BASELINE_EM[this.textBaseline] * Number(size);
    const place = `x="${round(x)}" y="${round(y + down)}" text-anchor="${ANCHOR[this.textAlign]}"`;
    const font = `font-family="${escaped(family)}" font-size="${size}" font-weight="${weight ?? 400}"`;
    this.#add(`<text ${place} ${font} ${paint}`, `>${escaped(text)}</text>`);
  }

  #add(start, end = "/>") {
    const place = this.#transform ? ` transform="${this.#transform}"` : "";
    const pale = this.globalAlpha < 1 ? ` opacity="${round(this.globalAlpha)}"` : "";
    const element = start + pale + place + end;
    // The clip is outside the transform: on the canvas it was set first.
    this.#parts.push(this.#clip ? `<g clip-path="${this.#clip}">${element}</g>` : element);
  }
}
