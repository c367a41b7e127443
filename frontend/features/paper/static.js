/** Static shapes: four series, each level in its own colour. */
import { html } from "../../core/ui.js";
import { niceCeil } from "../../core/axis.js";
import { rampColour } from "../../core/colours.js";
import { staticEdges } from "../../core/glottis.js";
import { Picture } from "../../core/picture.js";
import { palette, rootPx, smallFont, theme } from "../../core/theme.js";
import { drawShapes } from "../folds/shapes.js";
import { SHAPES } from "../folds/texts.js";
import { Claims, FigureTools, openCase } from "./parts.js";
import { figures } from "./state.js";
import { PAPER } from "./texts.js";

/** One scale for all four, so that they can be compared. */
function commonLimits(all) {
  const edges = all.flatMap(({ shapes }) => shapes.filter((s) => s.x_m)).map(staticEdges);
  const r = edges.flatMap(({ superior, inferior }) => [...superior, ...inferior]);
  const low = Math.min(...r, 0);
  return {
    x: [0, 5 * Math.ceil(Math.max(...edges.map((e) => e.lengthMm)) / 5)],
    r: [low < 0 ? -niceCeil(-low) : 0, niceCeil(Math.max(...r))],
  };
}

const share = (figure, k) => k / Math.max(1, figure.axes[0].values.length - 1);

export function PaperStatic() {
  return html`
    <p class="paper-row unit">${PAPER.hint}${" "}${PAPER.edges}</p>
    ${Object.keys(PAPER.series).map(
      (key) => html`
        <${Series} key=${key} name=${key} />
      `,
    )}
  `;
}

function Series({ name }) {
  const figure = figures.value[name];
  const words = PAPER.series[name];
  const model = () => {
    const shown = figures.value[name];
    const colours = palette.value;
    const shapes = shown.shapes.map(
      (shape, k) => shape.x_m && { edges: staticEdges(shape), colour: rampColour(share(shown, k), colours.theme) },
    );
    return {
      shapes: shapes.filter(Boolean),
      colours,
      limits: commonLimits(Object.keys(PAPER.series).map((key) => figures.value[key])),
    };
  };
  return html`
    <figure class="paper-figure" aria-labelledby=${`title-${name}`}>
      <figcaption>
        <h3 id=${`title-${name}`}>${words.name}${" "}0 to 1</h3>
        <span class="unit">${words.fixed}</span>
        <${FigureTools} figure=${figure} />
      </figcaption>
      <div class="paper-picture">
        <${Picture} name=${`paper-${name}`} model=${model} paint=${paint} label=${PAPER.seriesPicture(words.name)} />
      </div>
      <div class="levels" role="group" aria-label=${PAPER.hint}>
        ${figure.axes[0].values.map(
          (level, k) => html`
            <button
              type="button"
              key=${level}
              aria-label=${PAPER.opensLevel(words.name, level)}
              title=${PAPER.opensLevel(words.name, level)}
              onClick=${() => openCase(figure, [level])}
            >
              <i style=${{ background: rampColour(share(figure, k), theme.value) }}></i>
              ${level}
            </button>
          `,
        )}
      </div>
      <${Claims} keys=${figure.claims} />
    </figure>
  `;
}

function paint(context, size, { shapes, colours, limits }) {
  const unit = rootPx();
  const box = { left: 2.6 * unit, right: size.width - 0.6 * unit, top: 0.5 * unit, bottom: size.height - 1.4 * unit };
  drawShapes(context, box, shapes, limits, colours, smallFont(), SHAPES);
}
