/** The map of pitch behind the pad. */
import { signal } from "../ui.js";
import { readonly } from "../state/readonly.js";

const _map = signal(null);

/** {ct, ta, fo} with fo in Hz, CT outermost, null where nothing repeats; null before there is one. */
export const padMap = readonly(_map);
