/** The page on a phone: the stage stays on top, everything else is a tab below it. */
import { html } from "../../core/ui.js";
import { lazy, TabList } from "../../core/widgets.js";
import { result } from "../../state/answers.js";
import { panel, setPanel, setTab, tab } from "../../state/look.js";
import { Advanced, BreathAndTract, Muscles } from "../controls/panels.js";
import { Shapes } from "../folds/shapes.js";
import { lesson, loadLessons } from "../lessons/lessons.js";
import { Headline, PhonationState } from "../measures/headline.js";
import { HEADLINES } from "../measures/texts.js";
import { CONTENT as PANEL_CONTENT } from "./right-column.js";
import { PANELS, TABS } from "./texts.js";
import { TopBar } from "./top-bar.js";
import { SoundControls } from "../sound/view.js";
import { PostureLine, Stage } from "../stage/view.js";
import { SurfacePressures } from "../surface/view.js";
import { Waves } from "../waves/view.js";

const LessonCard = lazy(() => import("../lessons/view.js"), "LessonCard");
const MapPanel = lazy(() => import("../map/view.js"), "MapPanel");
const More = lazy(() => Promise.all([import("./more.js"), loadLessons()]).then(([module]) => module), "More");
const Play = lazy(() => import("../play/view.js"), "Play");
const MeasureTable = lazy(() => import("../measures/table.js"), "MeasureTable");

const WAVE_PANELS = Object.fromEntries(["waves", "voice", "folds", "compare"].map((key) => [key, PANELS[key]]));
const wavePanel = () => (panel.value in WAVE_PANELS ? panel.value : "waves");

const CONTENT = {
  muscles: () => html`
    <${PostureLine} />
    <${Muscles} />
    <${BreathAndTract} />
    <${Advanced} />
  `,
  play: () => html`
    <${Play} />
  `,
  waves: () => html`
    <${TabList} name="panel" texts=${WAVE_PANELS} chosen=${wavePanel()} choose=${setPanel} />
    <div role="tabpanel" id="panel-content" aria-labelledby=${`panel-${wavePanel()}`}>
      ${
        wavePanel() === "waves"
          ? html`
              <${Waves} />
              <${Shapes} />
              <${SurfacePressures} />
            `
          : PANEL_CONTENT[wavePanel()]()
      }
    </div>
  `,
  numbers: () => html`
    <div class="headlines">
      ${HEADLINES.map(
        (item) => html`
          <${Headline} key=${item.key} item=${item} shown=${result.value} />
        `,
      )}
    </div>
    <${MeasureTable} />
  `,
  map: () => html`
    <${MapPanel} />
  `,
  more: () => html`
    <${More} />
  `,
};

export function Phone() {
  return html`
    <div class="phone">
      <${TopBar} />
      <main class="phone-top">
        <${Stage} compact=${true} />
        <div class="phone-state">
          <${PhonationState} withLook=${true} />
          <${SoundControls} />
        </div>
      </main>
      ${
        lesson.value &&
        html`
          <${LessonCard} />
        `
      }
      <${TabList} name="tab" texts=${TABS} chosen=${tab.value} choose=${setTab} />
      <section
        key=${tab.value}
        class=${`phone-content tab-${tab.value}`}
        role="tabpanel"
        id="tab-content"
        aria-labelledby=${`tab-${tab.value}`}
      >
        ${CONTENT[tab.value]()}
      </section>
    </div>
  `;
}
