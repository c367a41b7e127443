/** The whole page: one screen on a desktop, a sticky stage above tabs on a phone. */
import { html, useRef, useState } from "../../core/ui.js";
import { call } from "../../core/api.js";
import { open } from "../../core/dialog.js";
import { APP } from "../../core/texts.js";
import { lazy } from "../../core/widgets.js";
import { result } from "../../state/answers.js";
import { mapShown, narrow, section } from "../../state/look.js";
import { schema } from "../../state/request.js";
import { announcement, connection, health, notice } from "../../state/session.js";
import { Advanced, BreathAndTract, Muscles } from "../controls/panels.js";
import { lesson } from "../lessons/lessons.js";
import { Headline, PhonationState } from "../measures/headline.js";
import { HEADLINES } from "../measures/texts.js";
import { HelpDialog, Use } from "./help.js";
import { Phone } from "./phone.js";
import { RightColumn } from "./right-column.js";
import { LOGIN } from "./texts.js";
import { TopBar } from "./top-bar.js";
import { SoundControls } from "../sound/view.js";
import { Stage } from "../stage/view.js";
import { SurfacePressures } from "../surface/view.js";

const CodeDialog = lazy(() => import("../export/view.js"), "CodeDialog");
const Detail = lazy(() => import("../waves/detail.js"), "Detail");
const ExportDialog = lazy(() => import("../export/view.js"), "ExportDialog");
const MeasureDialog = lazy(() => import("../measures/table.js"), "MeasureDialog");
const PaperPage = lazy(() => import("../paper/page.js"), "PaperPage");
const ReportDialog = lazy(() => import("../report/view.js"), "ReportDialog");
const LessonCard = lazy(() => import("../lessons/view.js"), "LessonCard");

const DIALOGS = {
  help: HelpDialog,
  measure: MeasureDialog,
  detail: Detail,
  export: ExportDialog,
  code: CodeDialog,
  report: ReportDialog,
};

/** `entered()` is called when the server has accepted a token. */
export function App({ entered }) {
  const shown = open.value;
  const Top = shown && DIALOGS[shown.name];
  return html`
    ${
      connection.value === "login"
        ? html`
            <${Login} entered=${entered} />
          `
        : !schema.value
          ? html`
              <${Starting} />
            `
          : section.value
            ? html`
                <${PaperPage}><${TopBar} /><//>
              `
            : narrow.value
              ? html`
                  <${Phone} />
                `
              : html`
                  <${Desktop} />
                `
    }
    ${
      Top &&
      html`
        <${Top} key=${shown.key ?? shown.name} about=${shown} />
      `
    }
    <p class="notice" role="status">${notice.value}</p>
    <p class="visually-hidden" aria-live="polite">${announcement.value}</p>
  `;
}

function Desktop() {
  return html`
    <div class="desktop">
      <${TopBar} />
      <aside class="left card" aria-label=${APP.controls}>
        <${Muscles} />
        <${BreathAndTract} />
        <${Advanced} />
        <${Use} short=${true} />
      </aside>
      ${
        mapShown.value
          ? html`
              <main class="whole"><${RightColumn} /></main>
            `
          : html`
              <main class="centre">
                <${Stage} />
                ${
                  lesson.value
                    ? html`
                        <${LessonCard} />
                      `
                    : html`
                        <${SurfacePressures} />
                      `
                }
              </main>
              <${RightColumn} />
            `
      }
      <${Strip} />
    </div>
  `;
}

export function Strip() {
  return html`
    <footer class="strip" data-result=${result.value?.id}>
      <${PhonationState} />
      <div class="headlines">
        ${HEADLINES.map(
          (item) => html`
            <${Headline} key=${item.key} item=${item} shown=${result.value} />
          `,
        )}
      </div>
      <${SoundControls} />
    </footer>
  `;
}

export function Starting() {
  const offline = connection.value === "offline";
  return html`
    <main class="gate">
      <div class="card" role="status">
        <h1>${APP.name}</h1>
        <p>
          ${offline ? APP.offline : health.value?.message ? `${APP.starting}: ${health.value.message}` : APP.starting}
        </p>
        <progress aria-label=${APP.starting}></progress>
        <p class="caution">${APP.startingWhy}</p>
      </div>
    </main>
  `;
}

/** `entered()` is called when the server has accepted the token. */
export function Login({ entered }) {
  const field = useRef(null);
  const [problem, setProblem] = useState("");
  const submit = async (event) => {
    event.preventDefault();
    try {
      await call("session", { method: "POST", body: { token: field.current.value.trim() } });
      entered();
    } catch (error) {
      setProblem(error.status === 401 || error.status === 403 ? LOGIN.wrong : error.message);
      field.current.select();
    }
  };
  return html`
    <main class="gate">
      <form class="card" onSubmit=${submit}>
        <h1>${LOGIN.title}</h1>
        <p>${LOGIN.about}</p>
        <label for="token">${LOGIN.token}</label>
        <input
          ref=${field}
          id="token"
          name="token"
          type="password"
          autocomplete="current-password"
          required
          aria-describedby="token-problem"
          autofocus
        />
        <p id="token-problem" class="refusal" role="alert">${problem}</p>
        <button type="submit" class="listen">${LOGIN.enter}</button>
      </form>
    </main>
  `;
}
