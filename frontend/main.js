/** Starts the page: waits for the model, reads what there is to set and to read, then follows hand, voice and address. */
import { effect, html, render } from "./ui.js";
import { Problem, getJson } from "./api.js";
import { followAudition } from "./audio/audition.js";
import { followVoice } from "./audio/sound.js";
import { Disposal } from "./dispose.js";
import { followKeys } from "./keys.js";
import { followRequest } from "./live.js";
import { stopFollowing } from "./longrun.js";
import { followMotion } from "./motion.js";
import { readSchema } from "./params.js";
import { palette } from "./plots/theme.js";
import { followSpeech } from "./speak.js";
import { followHistory } from "./state/history.js";
import { answered } from "./state/outcome.js";
import { begin, schema, version } from "./state/request.js";
import { followRest } from "./state/rested.js";
import { setConnection, setHealth, showNotice } from "./state/session.js";
import { TOP } from "./texts.js";
import { followTract } from "./tracts.js";
import { followUrl, readQuery } from "./url.js";
import { App } from "./views/App.js";

const POLL_MS = 400;

const page = new Disposal();
page.add(effect(() => void palette.value)); // sets the theme before the first paint
page.add(effect(() => document.body.setAttribute("aria-busy", String(answered.value !== version.value))));
render(html`<${App} entered=${start} />`, document.getElementById("page"));
for (const follow of [followKeys, followMotion, followVoice, followAudition, followRest, followHistory, followTract, followRequest, followUrl, followSpeech]) page.add(follow());
page.add(stopFollowing);
page.listen(window, "pagehide", (event) => !event.persisted && page.dispose());
start();

async function start() {
  try {
    const catalogue = schema.peek() ? null : askCatalogue(); // meanwhile: most often the model is ready
    await modelReady();
    if (!schema.peek()) takeCatalogue(await catalogue);
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
  answers.catch(() => {}); // told where it is waited for
  return answers;
}

function takeCatalogue([parameters, measures]) {
  const known = readSchema(parameters);
  const { changes, unknown } = readQuery(known, location.search);
  begin(known, measures.measures, changes);
  if (unknown.length) showNotice(TOP.unknown(unknown));
}
