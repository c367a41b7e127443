/** The right column: one of the ways to look at what came out. */
import { html } from "../ui.js";
import { panel, setPanel } from "../state/look.js";
import { PANELS } from "../texts.js";
import { Shapes } from "./Shapes.js";
import { TabList } from "./TabList.js";
import { Waves } from "./Waves.js";
import { lazy } from "./lazy.js";

const ComparePanel = lazy(() => import("./ComparePanel.js"), "ComparePanel");
const FoldsPanel = lazy(() => import("./FoldsPanel.js"), "FoldsPanel");
const HistoryList = lazy(() => import("./HistoryList.js"), "HistoryList");
const LessonList = lazy(() => import("./LessonList.js"), "LessonList");
const MapPanel = lazy(() => import("./MapPanel.js"), "MapPanel");
const LongRun = lazy(() => import("./LongRun.js"), "LongRun");
const Play = lazy(() => import("./Play.js"), "Play");
const VoicePanel = lazy(() => import("./VoicePanel.js"), "VoicePanel");
const MeasureTable = lazy(() => import("./MeasureTable.js"), "MeasureTable");

/** What stands under each tab; the phone shows some of them too. */
export const CONTENT = {
  waves: () => html`<${Waves} /><${Shapes} />`,
  voice: () => html`<${VoicePanel} />`,
  folds: () => html`<${FoldsPanel} />`,
  compare: () => html`<${ComparePanel} />`,
  measures: () => html`<${MeasureTable} />`,
  map: () => html`<${MapPanel} />`,
  play: () => html`<${Play} />`,
  lessons: () => html`<${LessonList} />`,
  run: () => html`<${LongRun} /><${HistoryList} />`,
};

export function RightColumn() {
  return html`
    <section class="right card">
      <${TabList} name="panel" texts=${PANELS} chosen=${panel.value} choose=${setPanel} />
      <div class=${`panel panel-${panel.value}`} role="tabpanel" id="panel-content" aria-labelledby=${`panel-${panel.value}`}>${CONTENT[panel.value]()}</div>
    </section>
  `;
}
