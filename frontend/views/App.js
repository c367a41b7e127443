/** The whole page: one screen on a desk, a sticky stage over tabs on a phone. */
import { html } from "../ui.js";
import { Advanced } from "../controls/Advanced.js";
import { BreathAndTract } from "../controls/BreathAndTract.js";
import { Muscles } from "../controls/Muscles.js";
import { TopBar } from "../controls/TopBar.js";
import { lesson } from "../state/lessons.js";
import { mapShown, narrow, open } from "../state/look.js";
import { section } from "../state/paper.js";
import { schema } from "../state/request.js";
import { announcement, connection, notice } from "../state/session.js";
import { APP } from "../texts.js";
import { Login } from "./Login.js";
import { Maps } from "./Maps.js";
import { Phone } from "./Phone.js";
import { RightColumn } from "./RightColumn.js";
import { Stage } from "./Stage.js";
import { Starting } from "./Starting.js";
import { Strip } from "./Strip.js";
import { Use } from "./Use.js";
import { lazy } from "./lazy.js";

const CodeDialog = lazy(() => import("./CodeDialog.js"), "CodeDialog");
const Detail = lazy(() => import("./Detail.js"), "Detail");
const KeepDialog = lazy(() => import("./KeepDialog.js"), "KeepDialog");
const MeasureDialog = lazy(() => import("./MeasureDialog.js"), "MeasureDialog");
const PaperPage = lazy(() => import("./PaperPage.js"), "PaperPage");
const ReportDialog = lazy(() => import("./ReportDialog.js"), "ReportDialog");
const HelpDialog = lazy(() => import("./HelpDialog.js"), "HelpDialog");
const LessonCard = lazy(() => import("./LessonCard.js"), "LessonCard");

const DIALOGS = { help: HelpDialog, measure: MeasureDialog, detail: Detail, keep: KeepDialog, code: CodeDialog, report: ReportDialog };

/** `entered()` is called when the server has taken a token. */
export function App({ entered }) {
  const shown = open.value;
  const Top = shown && DIALOGS[shown.name];
  return html`
    ${connection.value === "login" ? html`<${Login} entered=${entered} />` : !schema.value ? html`<${Starting} />` : section.value ? html`<${PaperPage} />` : narrow.value ? html`<${Phone} />` : html`<${Desk} />`}
    ${Top && html`<${Top} key=${shown.key ?? shown.name} about=${shown} />`}
    <p class="notice" role="status">${notice.value}</p>
    <p class="visually-hidden" aria-live="polite">${announcement.value}</p>
  `;
}

function Desk() {
  return html`
    <div class="desk">
      <${TopBar} />
      <aside class="left card" aria-label=${APP.controls}><${Muscles} /><${BreathAndTract} /><${Advanced} /><${Use} short=${true} /></aside>
      ${mapShown.value ? html`<main class="whole"><${RightColumn} /></main>` : html`<main class="centre"><${Stage} />${lesson.value ? html`<${LessonCard} />` : html`<${Maps} />`}</main><${RightColumn} />`}
      <${Strip} />
    </div>
  `;
}
