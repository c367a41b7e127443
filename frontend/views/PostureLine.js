/** The posture in numbers, and what the last hand movement did to it. */
import { html } from "../ui.js";
import { numberText } from "../plots/axis.js";
import { before, posture } from "../state/outcome.js";
import { STAGE } from "../texts.js";

const DEGREES = 180 / Math.PI;
const ITEMS = [
  { label: STAGE.strain, decimals: 3, read: (p) => p.strain },
  { label: STAGE.angle, decimals: 2, unit: "°", read: (p) => p.glottal_half_angle_rad * DEGREES },
  { label: STAGE.length, decimals: 2, unit: " mm", read: (p) => p.length_m * 1e3 },
];

export function PostureLine() {
  const now = posture.value;
  return html`
    <dl class="posture-line">
      ${ITEMS.map(({ label, decimals, unit = "", read }) => {
        const value = now && read(now.posture);
        const change = now && before.value ? value - read(before.value.posture) : 0;
        const seen = Math.abs(change) >= 0.5 * 10 ** -decimals;
        return html`
          <div>
            <dt>${label}</dt>
            <dd>${now ? numberText(value, decimals) + unit : "–"}</dd>
            <dd class="change">${seen ? `Δ ${change > 0 ? "+" : ""}${numberText(change, decimals)}` : ""}</dd>
          </div>
        `;
      })}
    </dl>
  `;
}
