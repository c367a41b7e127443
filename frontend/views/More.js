/** What a phone has under "More": sound, history, files, lessons, the model, longer runs. Fetched at once, so that nothing moves. */
import { html } from "../ui.js";
import { HistoryTools } from "../controls/HistoryTools.js";
import { SoundControls } from "../controls/SoundControls.js";
import { Variants } from "../controls/TopBar.js";
import { openDialog } from "../state/look.js";
import { KEEP, LESSONS, RUN } from "../texts.js";
import { HistoryList } from "./HistoryList.js";
import { LessonList } from "./LessonList.js";
import { LongRun } from "./LongRun.js";
import { Use } from "./Use.js";

export function More() {
  return html`
    <div class="more">
      <${SoundControls} />
      <${HistoryTools} />
      <button type="button" class="button" onClick=${() => openDialog("keep")}>${KEEP.title}</button>
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
