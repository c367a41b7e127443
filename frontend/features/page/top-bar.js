/** The top bar: name, voice, model, and the tools of the page itself. */
import { html, useComputed } from "../../core/ui.js";
import { copyText } from "../../core/clipboard.js";
import { openDialog } from "../../core/dialog.js";
import { APP } from "../../core/texts.js";
import { theme, toggleTheme } from "../../core/theme.js";
import { Icon } from "../../core/widgets.js";
import { mapShown, narrow, section, setSection } from "../../state/look.js";
import { choosePreset, chooseVariant, patch, preset, schema, values } from "../../state/request.js";
import { showNotice } from "../../state/session.js";
import { VARIANT_NAMES } from "../controls/texts.js";
import { EXPORT } from "../export/texts.js";
import { HistoryTools } from "../history/view.js";
import { TOP } from "./texts.js";
import { linkOf } from "./url.js";

export function TopBar() {
  return html`
    <header class="top">
      <h1 class="brand">
        <${Icon} name="mark" />
        ${APP.name}
      </h1>
      ${
        schema.value &&
        html`
          <${Presets} />
          ${
            !narrow.value &&
            html`
              <${Variants} />
            `
          }
        `
      }
      <div class="top-tools">
        ${
          schema.value &&
          !narrow.value &&
          html`
            <${HistoryTools} />
          `
        }
        <button
          class="quiet keep"
          type="button"
          aria-label=${EXPORT.open}
          title=${EXPORT.openHelp}
          onClick=${() => openDialog("export")}
        >
          <${Icon} name="keep" />
          <span>${EXPORT.open}</span>
        </button>
        <button
          class="quiet paper-button"
          type="button"
          aria-pressed=${section.value !== null}
          onClick=${() => setSection(section.value ? null : "static")}
        >
          ${section.value ? TOP.instrument : TOP.paper}
        </button>
        <button class="quiet" type="button" aria-label=${TOP.share} disabled=${!schema.value} onClick=${share}>
          <${Icon} name="link" />
          <span>${TOP.share}</span>
        </button>
        <button
          class="icon"
          type="button"
          aria-label=${theme.value === "dark" ? TOP.toLight : TOP.toDark}
          title=${theme.value === "dark" ? TOP.toLight : TOP.toDark}
          onClick=${toggleTheme}
        >
          <${Icon} name=${theme.value === "dark" ? "sun" : "moon"} />
        </button>
        <button
          class="icon"
          type="button"
          aria-label=${TOP.help}
          title=${`${TOP.help} (?)`}
          onClick=${() => openDialog("help")}
        >
          <${Icon} name="help" />
        </button>
      </div>
    </header>
  `;
}

function Presets() {
  const chosen = preset.value;
  return html`
    <label class="pick preset">
      <span>${TOP.preset}</span>
      <select
        aria-label=${TOP.preset}
        value=${chosen?.key ?? ""}
        title=${chosen?.look_for}
        onChange=${(event) => event.target.value && choosePreset(event.target.value)}
      >
        ${
          !chosen &&
          html`
            <option value="">${TOP.own}</option>
          `
        }
        ${schema.value.presets.map(
          ({ key, label }) => html`
            <option value=${key}>${label}</option>
          `,
        )}
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
        ${schema.value.variants.map(
          ({ key, help }) => html`
            <option value=${key} title=${help}>${VARIANT_NAMES[key] ?? key}</option>
          `,
        )}
      </select>
    </label>
  `;
}

async function share() {
  showNotice(
    (await copyText(linkOf(schema.peek(), patch.peek(), section.peek(), mapShown.peek())))
      ? TOP.shared
      : TOP.sharedFailed,
  );
}
