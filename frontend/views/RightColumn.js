/** The right column: waves, all measures, or a longer run. */
import { html } from "../ui.js";
import { panel, setPanel } from "../state/look.js";
import { PANELS } from "../texts.js";
import { LongRun } from "./LongRun.js";
import { MeasureTable } from "./MeasureTable.js";
import { Play } from "./Play.js";
import { Shapes } from "./Shapes.js";
import { TabList } from "./TabList.js";
import { Waves } from "./Waves.js";

const CONTENT = {
  waves: () => html`<${Waves} /><${Shapes} />`,
  measures: () => html`<${MeasureTable} />`,
  play: () => html`<${Play} />`,
  run: () => html`<${LongRun} />`,
};

export function RightColumn() {
  return html`
    <section class="right card">
      <${TabList} name="panel" texts=${PANELS} chosen=${panel.value} choose=${setPanel} />
      <div class=${`panel panel-${panel.value}`} role="tabpanel" id="panel-content" aria-labelledby=${`panel-${panel.value}`}>${CONTENT[panel.value]()}</div>
    </section>
  `;
}
