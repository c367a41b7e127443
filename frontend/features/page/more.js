/**
 * The tab "More" of a phone: sound, history, files, lessons, the model, longer runs. Loaded at once, so that nothing
 * moves.
 */
import { html } from "../../core/ui.js";
import { openDialog } from "../../core/dialog.js";
import { EXPORT } from "../export/texts.js";
import { HistoryList, HistoryTools } from "../history/view.js";
import { LESSONS } from "../lessons/texts.js";
import { LessonList } from "../lessons/view.js";
import { RUN } from "../long-run/texts.js";
import { LongRun } from "../long-run/view.js";
import { Use } from "./help.js";
import { Variants } from "./top-bar.js";
import { SoundControls } from "../sound/view.js";

export function More() {
  return html`
    <div class="more">
      <${SoundControls} />
      <${HistoryTools} />
      <button type="button" class="button" onClick=${() => openDialog("export")}>${EXPORT.title}</button>
      <h2>${LESSONS.title}</h2>
      <${LessonList} />
      <${Variants} />
      <h2>${RUN.title}</h2>
      <${LongRun} />
      <${HistoryList} />
      <${Use} />
    </div>
  `;
}
