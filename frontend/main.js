/**
 * Starts the page: waits for the model, reads the parameters and measures, then follows the user, the sound and the
 * address.
 */
import { effect, html, render } from "./core/ui.js";
import { getJson, Problem } from "./core/api.js";
import { Disposal } from "./core/dispose.js";
import { readSchema } from "./core/parameters.js";
import { palette } from "./core/theme.js";
import { answered } from "./state/answers.js";
import { awaitsDefaults, begin, schema, version } from "./state/request.js";
import { setConnection, setHealth, showNotice } from "./state/session.js";
import { followSettled } from "./state/settled.js";
import { followHistory } from "./features/history/history.js";
import { followAnnouncements } from "./features/live/announce.js";
import { firstDefaults, followDefaults } from "./features/live/follow-defaults.js";
import { followRequest } from "./features/live/follow-request.js";
import { stopFollowing } from "./features/long-run/run.js";
import { App } from "./features/page/app.js";
import { followKeys } from "./features/page/keys.js";
import { TOP } from "./features/page/texts.js";
import { followUrl, readQuery } from "./features/page/url.js";
import { followAudition } from "./features/sound/audition.js";
import { followSound } from "./features/sound/sound.js";
import { followTract } from "./features/spectrum/tract.js";
import { followMotion } from "./features/stage/animate.js";

const POLL_MS = 400;

const page = new Disposal();
page.add(effect(() => void palette.value)); // sets the theme before the first paint
page.add(
  effect(() => {
    document.body.setAttribute("aria-busy", String(answered.value !== version.value || awaitsDefaults.value));
  }),
);
render(
  html`
    <${App} entered=${start} />
  `,
  document.getElementById("page"),
);
for (const follow of [
  followKeys,
  followMotion,
  followSound,
  followAudition,
  followSettled,
  followHistory,
  followTract,
  followDefaults,
  followRequest,
  followUrl,
  followAnnouncements,
])
  page.add(follow());
page.add(stopFollowing);
page.listen(window, "pagehide", (event) => !event.persisted && page.dispose());
start();

async function start() {
  try {
    const catalogue = schema.peek() ? null : askCatalogue(); // at the same time: most often the model is ready
    await modelReady();
    if (!schema.peek()) await takeCatalogue(await catalogue);
    setConnection("ready");
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    setConnection(error.status === 401 ? "login" : "offline");
    if (error.status !== 401) setTimeout(start, 4 * POLL_MS);
  }
}

async function modelReady() {
  for (;;) {
    const health = await getJson("health");
    setHealth(health);
    if (health.ready) return;
    await new Promise((resolve) => setTimeout(resolve, POLL_MS));
  }
}

function askCatalogue() {
  const answers = Promise.all([getJson("parameters"), getJson("measures")]);
  answers.catch(() => {}); // reported where the answers are awaited
  return answers;
}

async function takeCatalogue([parameters, measures]) {
  const known = readSchema(parameters);
  const { patch, unknown } = readQuery(known, location.search);
  begin(known, measures.measures, patch, await firstDefaults(known, patch));
  if (unknown.length) showNotice(TOP.unknown(unknown));
}
