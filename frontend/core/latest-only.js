/**
 * Sends requests one at a time. While one is in flight, only the newest of the others waits; the rest are dropped.
 *
 * `send(job)` answers a promise; `done(answer, job)` and `failed(error, job)` are called in the order of sending.
 * After an answer it waits `restMs` before it sends again, which leaves the machine to other work.
 */
export class LatestOnly {
  #waiting = null;
  #busy = false;
  restMs = 0;

  constructor(send, done, failed) {
    this.send = send;
    this.done = done;
    this.failed = failed;
  }

  push(job) {
    this.#waiting = job;
    if (!this.#busy) this.#run();
  }

  async #run() {
    this.#busy = true;
    while (this.#waiting !== null) {
      const job = this.#waiting;
      this.#waiting = null;
      try {
        this.done(await this.send(job), job);
      } catch (error) {
        this.failed(error, job);
      }
      if (this.restMs) await new Promise((resolve) => setTimeout(resolve, this.restMs));
    }
    this.#busy = false;
  }
}
