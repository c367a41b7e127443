import { computed } from "../ui.js";

/** A signal others can read and follow but not write. */
export const readonly = (source) => computed(() => source.value);
