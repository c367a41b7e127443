/** One disposal path: whatever must end with its owner is added here and ends in reverse order. */
export class Disposal {
  #ends = [];

  /** Register `end` (a function) and return it. */
  add(end) {
    this.#ends.push(end);
    return end;
  }

  /** Listen on `target` until disposal. */
  listen(target, type, handler, options) {
    target.addEventListener(type, handler, options);
    return this.add(() => target.removeEventListener(type, handler, options));
  }

  dispose() {
    while (this.#ends.length) this.#ends.pop()();
  }
}
