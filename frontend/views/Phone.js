/** The page on a phone: the stage stays on top, everything else is a tab under it. */
import { html } from "../ui.js";
import { Advanced } from "../controls/Advanced.js";
import { BreathAndTract } from "../controls/BreathAndTract.js";
import { Muscles } from "../controls/Muscles.js";
import { SoundControls } from "../controls/SoundControls.js";
import { TopBar } from "../controls/TopBar.js";
import { loadLessons } from "../lessons.js";
import { lesson } from "../state/lessons.js";
import { panel, setPanel, setTab, tab } from "../state/look.js";
import { result } from "../state/outcome.js";
import { HEADLINES, PANELS, TABS } from "../texts.js";
import { Headline } from "./Headline.js";
import { Maps } from "./Maps.js";
import { PhonationState } from "./PhonationState.js";
import { PostureLine } from "./PostureLine.js";
import { CONTENT as PANEL_CONTENT } from "./RightColumn.js";
import { Shapes } from "./Shapes.js";
import { Stage } from "./Stage.js";
import { TabList } from "./TabList.js";
import { lazy } from "./lazy.js";
import { Waves } from "./Waves.js";

const LessonCard = lazy(() => import("./LessonCard.js"), "LessonCard");
const MapPanel = lazy(() => import("./MapPanel.js"), "MapPanel");
const More = lazy(() => Promise.all([import("./More.js"), loadLessons()]).then(([module]) => module), "More");
const Play = lazy(() => import("./Play.js"), "Play");
const MeasureTable = lazy(() => import("./MeasureTable.js"), "MeasureTable");

const WAVE_PANELS = Object.fromEntries(["waves", "voice", "folds", "compare"].map((key) => [key, PANELS[key]]));
const wavePanel = () => (panel.value in WAVE_PANELS ? panel.value : "waves");

const CONTENT = {
  muscles: () => html`<${PostureLine} /><${Muscles} /><${BreathAndTract} /><${Advanced} />`,
  play: () => html`<${Play} />`,
  waves: () => html`
    <${TabList} name="panel" texts=${WAVE_PANELS} chosen=${wavePanel()} choose=${setPanel} />
    <div role="tabpanel" id="panel-content" aria-labelledby=${`panel-${wavePanel()}`}>
      ${wavePanel() === "waves" ? html`<${Waves} /><${Shapes} /><${Maps} />` : PANEL_CONTENT[wavePanel()]()}
    </div>
  `,
  numbers: () => html`<div class="headlines">${HEADLINES.map((item) => html`<${Headline} key=${item.key} item=${item} shown=${result.value} />`)}</div><${MeasureTable} />`,
  map: () => html`<${MapPanel} />`,
  more: () => html`<${More} />`,
};

export function Phone() {
  return html`
    <div class="phone">
      <${TopBar} />
      <main class="phone-top">
        <${Stage} compact=${true} />
        <div class="phone-state"><${PhonationState} withLook=${true} /><${SoundControls} /></div>
      </main>
      ${lesson.value && html`<${LessonCard} />`}
      <${TabList} name="tab" texts=${TABS} chosen=${tab.value} choose=${setTab} />
      <section key=${tab.value} class=${`phone-content tab-${tab.value}`} role="tabpanel" id="tab-content" aria-labelledby=${`tab-${tab.value}`}>${CONTENT[tab.value]()}</section>
    </div>
  `;
}
