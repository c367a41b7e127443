/** The medial surface with its pressures at the phase under the cursor: two heat maps with their colour bars. */
import { effect, html, useComputed, useEffect, useRef } from "../../core/ui.js";
import { niceCeil, niceStep, numberText, ticks, tickText } from "../../core/axis.js";
import { colourGradient, paintField } from "../../core/colours.js";
import { offer } from "../../core/export.js";
import { forget, inFrame } from "../../core/frame.js";
import { fieldAt } from "../../core/result.js";
import { palette, rootPx, smallFont, theme } from "../../core/theme.js";
import { result } from "../../state/answers.js";
import { phase, readout } from "../../state/motion.js";
import { drawField } from "./paint.js";
import { SURFACE } from "./texts.js";

const LEAST_PA = 100; // smaller limits would show rounding errors

export function SurfacePressures() {
  const at = useComputed(() =>
    result.value?.cycle.complete === false ? SURFACE.atEnd : SURFACE.at(Math.floor(readout.value * 100)),
  );
  return html`
    <section class="maps card" aria-label=${SURFACE.where}>
      <div class="card-head">
        <h2>${SURFACE.where}</h2>
        <span class="when">${at}</span>
      </div>
      <${FieldMap} name="aero" title=${SURFACE.aero} scaleOf=${pressureScale} moment=${() => at.peek()} />
      <${FieldMap} name="contact" title=${SURFACE.contact} scaleOf=${contactScale} moment=${() => at.peek()} />
    </section>
  `;
}

/** Limits over the whole cycle, round and centred on zero. */
export function pressureScale({ aeroRange: { min, max } }) {
  const limit = niceCeil(Math.max(-min, max, LEAST_PA));
  return { kind: "diverging", limit, low: -limit };
}

/** From zero up; below zero only where contact pulls instead of pushing. */
export function contactScale({ contactRange: { min, max } }) {
  return { kind: "sequential", limit: niceCeil(Math.max(max, LEAST_PA)), low: min < 0 ? -niceCeil(-min) : 0 };
}

const EXPORT_REM = { width: 30, height: 13 };

/** One heat map. `scaleOf(fields)` → {kind, limit, low} in Pa; `moment()`: the phase in words, for the file. */
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
    const withdraw = offer({ name: `map-${name}`, title, size: exportSize, model: exportModel, paint: paintExport });
    return () => {
      stop();
      withdraw();
      forget(place);
    };
  }, []);
  const exportModel = () =>
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
      <figcaption>
        ${title}${" "}
        <span class="unit">Pa</span>
      </figcaption>
      <div class="map-side">
        <span>${SURFACE.superior}</span>
        <span>${millimetres(fields?.y.at(-1))}</span>
        <span>${SURFACE.inferior}</span>
      </div>
      <div class="map-field" style=${fields && { "--nx": fields.nx, "--ny": fields.ny }}>
        <canvas
          ref=${canvas}
          data-picture=${`map-${name}`}
          role="img"
          aria-label=${`${title}: ${SURFACE.where}`}
        ></canvas>
      </div>
      <div class="map-foot">
        <span>${SURFACE.anterior}</span>
        <span>${millimetres(fields?.x.at(-1))}</span>
        <span>${SURFACE.posterior}</span>
      </div>
      ${
        scale.value &&
        html`
          <${ColourBar} scale=${scale.value} />
        `
      }
    </figure>
  `;
}

const exportSize = () => ({ width: EXPORT_REM.width * rootPx(), height: EXPORT_REM.height * rootPx() });
const paintExport = (context, box, model) => drawField(context, box, model, rootPx(), smallFont(), SURFACE);

function ColourBar({ scale }) {
  const { low, limit } = scale;
  const step = niceStep(limit - low, 4);
  return html`
    <div class="map-bar" style=${{ background: colourGradient(scale, theme.value) }}>
      ${ticks(low, limit, 4).map(
        (mark) => html`
          <span style=${{ bottom: `${(100 * (mark - low)) / (limit - low)}%` }}>${tickText(mark, step)}</span>
        `,
      )}
    </div>
  `;
}
