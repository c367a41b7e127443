/** The page on a phone: the stage stays on top, everything else is a tab under it. */
import { html } from "../ui.js";
import { Advanced } from "../controls/Advanced.js";
import { BreathAndTract } from "../controls/BreathAndTract.js";
import { Muscles } from "../controls/Muscles.js";
import { SoundControls } from "../controls/SoundControls.js";
import { TopBar, Variants } from "../controls/TopBar.js";
import { setTab, tab } from "../state/look.js";
import { result } from "../state/outcome.js";
import { APP, HEADLINES, RUN, TABS } from "../texts.js";
import { Headline } from "./Headline.js";
import { LongRun } from "./LongRun.js";
import { Maps } from "./Maps.js";
import { MeasureTable } from "./MeasureTable.js";
import { Play } from "./Play.js";
import { PhonationState } from "./PhonationState.js";
import { PostureLine } from "./PostureLine.js";
import { Shapes } from "./Shapes.js";
import { Stage } from "./Stage.js";
import { TabList } from "./TabList.js";
import { Waves } from "./Waves.js";

const CONTENT = {
  muscles: () => html`<${PostureLine} /><${Muscles} /><${BreathAndTract} /><${Advanced} />`,
  play: () => html`<${Play} />`,
  waves: () => html`<${Waves} /><${Shapes} /><${Maps} />`,
  numbers: () => html`<div class="headlines">${HEADLINES.map((item) => html`<${Headline} key=${item.key} item=${item} shown=${result.value} />`)}</div><${MeasureTable} />`,
  more: () => html`<${SoundControls} /><${Variants} /><h2>${RUN.title}</h2><${LongRun} /><p class="use">${APP.use}</p>`,
};

export function Phone() {
  return html`
    <div class="phone">
      <${TopBar} />
      <main class="phone-top">
        <${Stage} compact=${true} />
        <div class="phone-state"><${PhonationState} /><${SoundControls} /></div>
      </main>
      <${TabList} name="tab" texts=${TABS} chosen=${tab.value} choose=${setTab} />
      <section class=${`phone-content tab-${tab.value}`} role="tabpanel" id="tab-content" aria-labelledby=${`tab-${tab.value}`}>${CONTENT[tab.value]()}</section>
    </div>
  `;
}
