/** The voice as a script and as a call, ready to run. */
import { html, useState } from "../ui.js";
import { link } from "../api.js";
import { copyText } from "../copy.js";
import { curlCode, pythonCode } from "../kept.js";
import { LIVE_S } from "../live.js";
import { simulationRequest } from "../params.js";
import { schema, values } from "../state/request.js";
import { CODE } from "../texts.js";
import { Dialog } from "./Dialog.js";

export function CodeDialog() {
  const request = simulationRequest(schema.value, values.value, { duration_s: LIVE_S });
  return html`
    <${Dialog} title=${CODE.title} wide=${false}>
      <${Listing} name="python" title=${CODE.python} help=${CODE.pythonHelp} text=${pythonCode(request)} />
      <${Listing} name="curl" title=${CODE.curl} help=${CODE.curlHelp} text=${curlCode(request, link(""))} />
    <//>
  `;
}

function Listing({ name, title, help, text }) {
  const [said, say] = useState("");
  const copy = async () => say((await copyText(text)) ? CODE.copied : CODE.copyFailed);
  return html`
    <section class="listing">
      <div class="card-head"><h3>${title}</h3><span role="status" class="when">${said}</span><button type="button" class="button small" onClick=${copy}>${CODE.copy}</button></div>
      <pre tabindex="0" data-code=${name}>${text}</pre>
      <p class="caution">${help}</p>
    </section>
  `;
}
