/** Keys that work everywhere on the page. */
import { open, openDialog } from "../../core/dialog.js";
import { Disposal } from "../../core/dispose.js";
import { result } from "../../state/answers.js";
import { narrow, setPanel, setTab } from "../../state/look.js";
import { holdPhase, moving, phase, setMoving } from "../../state/motion.js";
import { musclePaths, schema } from "../../state/request.js";
import { focusControl } from "../controls/fields.js";
import { redo, undo } from "../history/history.js";
import { toggleHold } from "../history/view.js";
import { canPlay, isOn, startPlaying, stopPlaying } from "../play/player.js";
import { toggleSound } from "../sound/sound.js";

const PHASE_STEP = 0.01;

/** Starts listening; returns a function that stops it. */
export function followKeys() {
  const disposal = new Disposal();
  disposal.listen(document, "keydown", onKey);
  return () => disposal.dispose();
}

function onKey(event) {
  if (isUndo(event)) {
    event.preventDefault();
    return event.shiftKey ? redo() : undo();
  }
  if (event.ctrlKey || event.metaKey || event.altKey || open.peek() || !schema.peek() || takesText(event.target))
    return;
  const action = actionOf(event.key, event.target);
  if (!action) return;
  event.preventDefault();
  action();
}

const isUndo = (event) =>
  (event.ctrlKey || event.metaKey) &&
  !event.altKey &&
  event.key.toLowerCase() === "z" &&
  !open.peek() &&
  !takesText(event.target);

const takesText = (target) =>
  target.matches?.("input:not([type=range], [type=checkbox], [type=radio]), select, textarea");

function actionOf(key, target) {
  if (key === " ") return takesSpace(target) || !result.peek() ? null : toggleSound;
  if (key === "?") return () => openDialog("help");
  if (key === "a" || key === "A") return () => toggleHold("a");
  if (key === "b" || key === "B") return () => toggleHold("b");
  if (key === "p" || key === "P") return togglePlay;
  if (key === "m" || key === "M") return () => setMoving(!moving.peek());
  if (key === "[") return () => holdPhase(phase.peek() - PHASE_STEP);
  if (key === "]") return () => holdPhase(phase.peek() + PHASE_STEP);
  const path = /^[1-9]$/.test(key) ? musclePaths()[Number(key) - 1] : undefined;
  return path ? () => chooseMuscle(path) : null;
}

/** A focused button takes Space itself. */
const takesSpace = (target) => target.matches?.("button, a, summary, input[type=checkbox], input[type=radio], audio");

/** Start and show the played voice, or stop it and leave the page unchanged. */
function togglePlay() {
  if (isOn()) return stopPlaying();
  if (!canPlay()) return;
  if (narrow.peek()) setTab("play");
  else setPanel("play");
  startPlaying();
}

function chooseMuscle(path) {
  if (narrow.peek()) setTab("muscles");
  requestAnimationFrame(() => focusControl(path));
}
