/** One heat map: the field at the phase shown, its two ends and lengths in words, its colour bar. */
import { effect, html, useComputed, useEffect, useRef } from "../ui.js";
import { forget, inFrame } from "../frame.js";
import { niceStep, numberText, tickText, ticks } from "../plots/axis.js";
import { colourGradient } from "../plots/colours.js";
import { drawField } from "../plots/field-draw.js";
import { offer } from "../plots/figures.js";
import { paintField } from "../plots/map-image.js";
import { palette, rootPx, smallFont } from "../plots/theme.js";
import { fieldAt } from "../result.js";
import { theme } from "../state/look.js";
import { phase } from "../state/motion.js";
import { result } from "../state/outcome.js";
import { MAPS } from "../texts.js";

const KEPT_REM = { width: 30, height: 13 };

/** `scaleOf(fields)` → {kind, limit, low} in Pa; `moment()`: the phase shown in words, for the file. */
export function FieldMap({ name, title, scaleOf, moment }) {
  const canvas = useRef(null);
  const scale = useComputed(() => (result.value ? scaleOf(result.value.fields) : null));
  useEffect(() => {
    const place = canvas.current;
    const stop = effect(() => {
      const shown = result.value;
      if (!shown) return;
      const [at, limits, colours] = [phase.value, scale.value, theme.value];
      inFrame(place, () => paintField(place, shown.fields, fieldAt(shown.fields, name, at), limits, colours));
    });
    const withdraw = offer({ name: `map-${name}`, title, size: keptSize, model: keptModel, paint: paintKept });
    return () => {
      stop();
      withdraw();
      forget(place);
    };
  }, []);
  const keptModel = () =>
    result.peek() && {
      fields: result.peek().fields,
      values: fieldAt(result.peek().fields, name, phase.peek()),
      scale: scale.peek(),
      colours: palette.peek(),
      heading: `${title}, Pa, ${moment()}`,
    };
  const fields = result.value?.fields;
  const millimetres = (metres) => (fields ? `${numberText(metres * 1e3, 1)} mm` : "");
  return html`
    <figure class="map">
      <figcaption>${title} <span class="unit">Pa</span></figcaption>
      <div class="map-side"><span>${MAPS.superior}</span><span>${millimetres(fields?.y.at(-1))}</span><span>${MAPS.inferior}</span></div>
      <div class="map-field" style=${fields && { "--nx": fields.nx, "--ny": fields.ny }}>
        <canvas ref=${canvas} data-picture=${`map-${name}`} role="img" aria-label=${`${title}: ${MAPS.where}`}></canvas>
      </div>
      <div class="map-foot"><span>${MAPS.anterior}</span><span>${millimetres(fields?.x.at(-1))}</span><span>${MAPS.posterior}</span></div>
      ${scale.value && html`<${ColourBar} scale=${scale.value} />`}
    </figure>
  `;
}

const keptSize = () => ({ width: KEPT_REM.width * rootPx(), height: KEPT_REM.height * rootPx() });
const paintKept = (context, box, model) => drawField(context, box, model, rootPx(), smallFont(), MAPS);

function ColourBar({ scale }) {
  const { low, limit } = scale;
  const step = niceStep(limit - low, 4);
  return html`
    <div class="map-bar" style=${{ background: colourGradient(scale, theme.value) }}>
      ${ticks(low, limit, 4).map((mark) => html`<span style=${{ bottom: `${(100 * (mark - low)) / (limit - low)}%` }}>${tickText(mark, step)}</span>`)}
    </div>
  `;
}
