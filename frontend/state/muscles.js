/** The muscles of the schema, in its order: keys 1 to 5. */
import { schema } from "./request.js";

export const musclePaths = () => [...schema.value.parameters.values()].filter((row) => row.group === "muscles").map((row) => row.key);

/** "activation.ta" → "ta", which also names the muscle's colour. */
export const muscleOf = (path) => path.split(".").at(-1);
