/** Shown until the model is compiled. */
import { html } from "../ui.js";
import { connection, health } from "../state/session.js";
import { APP } from "../texts.js";

export function Starting() {
  const offline = connection.value === "offline";
  return html`
    <main class="gate">
      <div class="card" role="status">
        <h1>${APP.name}</h1>
        <p>${offline ? APP.offline : health.value?.message ? `${APP.starting}: ${health.value.message}` : APP.starting}</p>
        <progress aria-label=${APP.starting}></progress>
        <p class="caution">${APP.startingWhy}</p>
      </div>
    </main>
  `;
}
