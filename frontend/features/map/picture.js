/** What the picture of the map and its legend show. */
import { computed } from "../../core/ui.js";
import { catalogue, muscleOf, schema, values } from "../../state/request.js";
import { difference, heldMap, map, measure } from "./state.js";
import { differenceOf, mapOf, samePoints } from "./sweep.js";
import { MAP } from "./texts.js";

/** {values, states} of the chosen measure, or of its difference from A; null before the first map. */
export const shownCells = computed(() => {
  if (!map.value) return null;
  const [a, b] = [heldMap.value?.table, map.value.table];
  return difference.value && a && samePoints(a, b) ? differenceOf(a, b, measure.value) : mapOf(b, measure.value);
});

const isDifference = () =>
  difference.value && heldMap.value !== null && samePoints(heldMap.value.table, map.value.table);

/** "CT", "LCA = IA", or the name of a number with its unit. */
export function axisLabel({ paths: [path, tied] }) {
  if (tied) return MAP.tiedShort;
  const row = schema.value.parameters.get(path);
  if (row.group === "muscles") return row.short;
  return `${row.name}${row.unit === "1" ? "" : ` (${row.unit})`}`;
}

/** The same in full: "Cricothyroid (CT)". */
function axisName(axis) {
  const row = schema.value.parameters.get(axis.paths[0]);
  return row.group === "muscles" && axis.paths.length === 1 ? `${row.name} (${row.short})` : axisLabel(axis);
}

/** The argument of activationMapFigure. */
export function pictureOf(colours) {
  const { axes } = map.value.table;
  const row = catalogue.value.get(measure.value);
  const [y, x] = axes.map((axis) => ({
    label: axisName(axis),
    values: axis.values,
    format: ".4~g",
    colour: axis.paths.length === 1 ? colours[muscleOf(axis.paths[0])] : undefined,
  }));
  const [up, right] = axes.map(({ paths }) => values.value[paths[0]]);
  return {
    ...shownCells.value,
    y,
    x,
    unit: row.unit === "1" ? "" : row.unit,
    decimals: row.decimals,
    diverging: isDifference(),
    markAll: true,
    current: up === null || right === null ? null : { x: right, y: up },
  };
}
