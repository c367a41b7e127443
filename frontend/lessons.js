/** Fetches lessons from the files beside the page. */
import { beginLesson, lessons, takeLessonProblem, takeLessons } from "./state/lessons.js";

const read = async (name) => {
  const response = await fetch(new URL(`lessons/${name}.json`, document.baseURI));
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
