/**
 * The lessons: which there are, how they are loaded, and the present step. A step sets the voice and what to look at.
 */
import { batch, computed, readonly, signal } from "../../core/ui.js";
import { showPanel } from "../../state/look.js";
import { setMoving, setSlowdown } from "../../state/motion.js";
import { restorePatch } from "../../state/request.js";

const _index = signal(null);
const _lesson = signal(null);
const _step = signal(0);
const _problem = signal(false);

/** [{key, title, about, steps}], or null before they are loaded. */
export const lessons = readonly(_index);
/** The present lesson, or null. */
export const lesson = readonly(_lesson);
export const step = readonly(_step);
export const lessonProblem = readonly(_problem);
export const present = computed(() => _lesson.value?.steps[_step.value] ?? null);

/** Keys of the measures that a step names. Pure. */
export const measuresOf = ({ expect }) => [...new Set(expect.flatMap(({ measure }) => measure ?? []))];

export function takeLessons(index) {
  _index.value = index;
  _problem.value = false;
}

export function takeLessonProblem() {
  _problem.value = true;
}

export function beginLesson(full) {
  _lesson.value = full;
  goToStep(0);
}

export function goToStep(place) {
  const { set, look } = _lesson.peek().steps[place];
  batch(() => {
    _step.value = place;
    restorePatch({}, set);
    showPanel(look.panel);
    if (look.slowdown) {
      setSlowdown(look.slowdown);
      setMoving(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    }
  });
}

/** Back to the list; the voice is unchanged. */
export function endLesson() {
  batch(() => {
    _lesson.value = null;
    showPanel("lessons");
  });
}

const read = async (name) => {
  const response = await fetch(new URL(`${name}.json`, import.meta.url));
  if (!response.ok) throw new Error(`${name}: ${response.status}`);
  return response.json();
};

export async function loadLessons() {
  if (lessons.peek()) return;
  try {
    takeLessons(await read("index"));
  } catch {
    takeLessonProblem();
  }
}

export async function startLesson(key) {
  try {
    beginLesson(await read(key));
  } catch {
    takeLessonProblem();
  }
}
