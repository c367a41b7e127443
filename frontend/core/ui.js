/** Markup and state of the whole page: Preact elements from htm templates, and signals that both understand. */
import htm from "../vendor/htm.js";
import * as preact from "../vendor/preact.js";
import * as hooks from "../vendor/preact-hooks.js";
import * as signals from "../vendor/signals.js";

// The vendored files are minified and say nothing about types; the packages of the same versions do.
export const { Fragment, h, render } = /** @type {typeof import("preact")} */ (/** @type {unknown} */ (preact));
export const { useEffect, useId, useLayoutEffect, useRef, useState } = /** @type {typeof import("preact/hooks")} */ (
  hooks
);
export const { batch, computed, effect, signal, untracked, useComputed, useSignal } =
  /** @type {typeof import("@preact/signals")} */ (/** @type {unknown} */ (signals));

export const html = /** @type {(parts: TemplateStringsArray, ...values: any[]) => any} */ (htm.bind(h));

/**
 * A signal that others can read and follow, but not write.
 *
 * @template T
 * @param {import("@preact/signals").Signal<T>} source
 */
export const readonly = (source) => computed(() => source.value);
