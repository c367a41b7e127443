/** Name, voice, model, and the few things about the page itself. */
import { html, useComputed } from "../ui.js";
import { copyText } from "../copy.js";
import { mapShown, narrow, openDialog, theme, toggleTheme } from "../state/look.js";
import { section, setSection } from "../state/paper.js";
import { choosePreset, chooseVariant, preset, schema, values } from "../state/request.js";
import { showNotice } from "../state/session.js";
import { APP, KEEP, TOP, VARIANT_NAMES } from "../texts.js";
import { linkOf } from "../url.js";
import { HistoryTools } from "./HistoryTools.js";
import { Icon } from "./Icon.js";

export function TopBar() {
  return html`
    <header class="top">
      <h1 class="brand"><${Icon} name="mark" />${APP.name}</h1>
      ${schema.value && html`<${Presets} />${!narrow.value && html`<${Variants} />`}`}
      <div class="top-tools">
        ${schema.value && !narrow.value && html`<${HistoryTools} />`}
        <button class="quiet keep" type="button" aria-label=${KEEP.open} title=${KEEP.openHelp} onClick=${() => openDialog("keep")}><${Icon} name="keep" /><span>${KEEP.open}</span></button>
        <button class="quiet paper-button" type="button" aria-pressed=${section.value !== null} onClick=${() => setSection(section.value ? null : "static")}>${section.value ? TOP.instrument : TOP.paper}</button>
        <button class="quiet" type="button" aria-label=${TOP.share} disabled=${!schema.value} onClick=${share}><${Icon} name="link" /><span>${TOP.share}</span></button>
        <button class="icon" type="button" aria-label=${theme.value === "dark" ? TOP.toLight : TOP.toDark} title=${theme.value === "dark" ? TOP.toLight : TOP.toDark} onClick=${toggleTheme}>
          <${Icon} name=${theme.value === "dark" ? "sun" : "moon"} />
        </button>
        <button class="icon" type="button" aria-label=${TOP.help} title=${`${TOP.help} (?)`} onClick=${() => openDialog("help")}><${Icon} name="help" /></button>
      </div>
    </header>
  `;
}

function Presets() {
  const chosen = preset.value;
  return html`
    <label class="pick preset">
      <span>${TOP.preset}</span>
      <select aria-label=${TOP.preset} value=${chosen?.key ?? ""} title=${chosen?.look_for} onChange=${(event) => event.target.value && choosePreset(event.target.value)}>
        ${!chosen && html`<option value="">${TOP.own}</option>`}
        ${schema.value.presets.map(({ key, label }) => html`<option value=${key}>${label}</option>`)}
      </select>
    </label>
    <p class="look-for">${chosen?.look_for}</p>
  `;
}

export function Variants() {
  const chosen = useComputed(() => values.value["model.variant"]).value;
  return html`
    <label class="pick variant">
      <span>${TOP.variant}</span>
      <select aria-label=${TOP.variant} value=${chosen} onChange=${(event) => chooseVariant(event.target.value)}>
        ${schema.value.variants.map(({ key, help }) => html`<option value=${key} title=${help}>${VARIANT_NAMES[key] ?? key}</option>`)}
      </select>
    </label>
  `;
}

async function share() {
  showNotice((await copyText(linkOf(schema.peek(), values.peek(), section.peek(), mapShown.peek()))) ? TOP.shared : TOP.sharedFailed);
}
