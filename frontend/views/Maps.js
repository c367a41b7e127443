/** The medial surface with its pressures at the phase under the cursor. */
import { html, useComputed } from "../ui.js";
import { niceCeil, niceStep, numberText, tickText, ticks } from "../plots/axis.js";
import { MapPainter, drawColourBar } from "../plots/map-draw.js";
import { palette, smallFont } from "../plots/theme.js";
import { extent, fieldAt } from "../result.js";
import { phase } from "../state/motion.js";
import { result } from "../state/outcome.js";
import { MAPS } from "../texts.js";
import { Picture } from "./Picture.js";

export function Maps() {
  const at = useComputed(() => MAPS.at(Math.floor(phase.value * 100)));
  return html`
    <section class="maps card" aria-label=${MAPS.where}>
      <div class="card-head"><h2>${MAPS.where}</h2><span class="when">${at}</span></div>
      ${["aero", "contact"].map((name) => html`
        <figure class="map" key=${name}>
          <figcaption>${MAPS[name]} <span class="unit">Pa</span></figcaption>
          <${Picture} name=${`map-${name}`} ...${mapOf(name)} label=${`${MAPS[name]}, ${MAPS.where}`} />
        </figure>
      `)}
    </section>
  `;
}

/** Limits of a map over the whole cycle, round: {kind, limit, low}. */
export function mapScale(name, fields) {
  const { min, max } = extent(fields[name]);
  if (name === "aero") {
    const limit = niceCeil(Math.max(-min, max)) || 1;
    return { kind: "diverging", limit, low: -limit };
  }
  return { kind: "sequential", limit: niceCeil(max) || 1, low: min < 0 ? -niceCeil(-min) : 0 };
}

function mapOf(name) {
  const painter = new MapPainter();
  const model = () => {
    const shown = result.value;
    if (!shown) return null;
    const { fields } = shown;
    return { fields, values: fieldAt(fields, name, phase.value), scale: mapScale(name, fields), colours: palette.value };
  };
  const paint = (context, size, { fields, values, scale, colours }) => {
    const unit = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const box = { x: 3.9 * unit, y: 0.3 * unit, width: size.width - 8.2 * unit, height: size.height - 1.7 * unit };
    painter.draw(context, box, values, fields, scale, colours.theme);
    drawAxes(context, box, fields, colours);
    drawBar(context, { x: box.x + box.width + 0.7 * unit, y: box.y, width: 0.65 * unit, height: box.height }, scale, colours);
  };
  return { model, paint };
}

/** The ends in words, the lengths between them: the axes are fractions of a surface that stretches with the posture. */
function drawAxes(context, box, { x, y, nx, ny }, colours) {
  context.font = smallFont();
  context.fillStyle = colours.inkSoft;
  context.textAlign = "right";
  context.textBaseline = "top";
  context.fillText(MAPS.superior, box.x - 6, box.y);
  context.textBaseline = "bottom";
  context.fillText(MAPS.inferior, box.x - 6, box.y + box.height);
  const foot = box.y + box.height + 5;
  context.textBaseline = "top";
  context.textAlign = "left";
  context.fillText(MAPS.anterior, box.x, foot);
  context.textAlign = "right";
  context.fillText(MAPS.posterior, box.x + box.width, foot);
  context.textAlign = "center";
  context.fillText(`${numberText(x[nx - 1] * 1e3, 1)} mm`, box.x + box.width / 2, foot);
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.fillText(`${numberText(y[ny - 1] * 1e3, 1)} mm`, box.x - 6, box.y + box.height / 2);
}

function drawBar(context, bar, scale, colours) {
  drawColourBar(context, bar, scale, colours.theme);
  context.fillStyle = colours.inkSoft;
  context.textAlign = "left";
  context.textBaseline = "middle";
  const step = niceStep(scale.limit - scale.low, 4);
  for (const mark of ticks(scale.low, scale.limit, 4)) {
    const y = bar.y + ((scale.limit - mark) / (scale.limit - scale.low)) * bar.height;
    context.fillText(tickText(mark, step), bar.x + bar.width + 5, Math.max(bar.y + 4, Math.min(bar.y + bar.height - 4, y)));
  }
}
