/** The right column: the panels that show the result. */
import { html } from "../../core/ui.js";
import { lazy, TabList } from "../../core/widgets.js";
import { panel, setPanel } from "../../state/look.js";
import { HistoryList } from "../history/view.js";
import { Shapes } from "../folds/shapes.js";
import { PANELS } from "./texts.js";
import { Waves } from "../waves/view.js";

const ComparePanel = lazy(() => import("../compare/view.js"), "ComparePanel");
const FoldsPanel = lazy(() => import("../folds/panel.js"), "FoldsPanel");
const LessonList = lazy(() => import("../lessons/view.js"), "LessonList");
const MapPanel = lazy(() => import("../map/view.js"), "MapPanel");
const LongRun = lazy(() => import("../long-run/view.js"), "LongRun");
const Play = lazy(() => import("../play/view.js"), "Play");
const SpectrumPanel = lazy(() => import("../spectrum/view.js"), "SpectrumPanel");
const MeasureTable = lazy(() => import("../measures/table.js"), "MeasureTable");

/** The content of each tab; the phone shows some of them too. */
export const CONTENT = {
  waves: () => html`
    <${Waves} />
    <${Shapes} />
  `,
  voice: () => html`
    <${SpectrumPanel} />
  `,
  folds: () => html`
    <${FoldsPanel} />
  `,
  compare: () => html`
    <${ComparePanel} />
  `,
  measures: () => html`
    <${MeasureTable} />
  `,
  map: () => html`
    <${MapPanel} />
  `,
  play: () => html`
    <${Play} />
  `,
  lessons: () => html`
    <${LessonList} />
  `,
  run: () => html`
    <${LongRun} />
    <${HistoryList} />
  `,
};

export function RightColumn() {
  return html`
    <section class="right card">
      <${TabList} name="panel" texts=${PANELS} chosen=${panel.value} choose=${setPanel} />
      <div
        class=${`panel panel-${panel.value}`}
        role="tabpanel"
        id="panel-content"
        aria-labelledby=${`panel-${panel.value}`}
      >
        ${CONTENT[panel.value]()}
      </div>
    </section>
  `;
}
