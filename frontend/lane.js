/**
 * A lane of requests: one in flight, the newest waiting, everything between forgotten.
 *
 * `send(job)` answers a promise; `done(answer, job)` and `failed(error, job)` are called in the order of sending.
 */
export class Lane {
  #waiting = null;
  #busy = false;

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
    }
    this.#busy = false;
  }
}
