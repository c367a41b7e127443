/**
 * A lane of requests: one in flight, the newest waiting, everything between forgotten.
 *
 * `send(job)` answers a promise; `done(answer, job)` and `failed(error, job)` are called in the order of sending.
 * `restMs` after an answer the lane leaves the machine to others before it sends again.
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
