/**
 * Plays blocks of sound as they come, from a small buffer that adapts: it grows after a gap and shrinks again when
 * minutes pass without one. Falls silent and comes back by fading, never by a click.
 */

const FADE = 240; // samples, 5 ms at 48 kHz
const CAPACITY = 1 << 15;
const LEAST_MS = 25;
const MOST_MS = 200;
const GROW_MS = 10;
const CALM_S = 20; // without a gap for so long: one step smaller
const REPORT_EVERY = 24; // quanta of 128 samples: 64 ms

class Stream extends AudioWorkletProcessor {
  constructor() {
    super();
    this.ring = new Float32Array(CAPACITY);
    this.read = 0;
    this.write = 0;
    this.playing = false;
    this.gain = 0;
    this.last = 0;
    this.wantedMs = LEAST_MS + 2 * GROW_MS;
    this.gaps = 0;
    this.played = 0;
    this.calmSince = 0;
    this.quanta = 0;
    this.port.onmessage = ({ data }) => this.take(data);
  }

  take(block) {
    for (let k = 0; k < block.length; k++) this.ring[(this.write + k) & (CAPACITY - 1)] = block[k];
    this.write += block.length;
    if (this.write - this.read > CAPACITY) this.read = this.write - CAPACITY;
  }

  process(_, [[out]]) {
    const waiting = this.write - this.read;
    if (!this.playing && waiting >= (this.wantedMs * sampleRate) / 1000) this.playing = true;
    for (let k = 0; k < out.length; k++) {
      const dry = this.read >= this.write;
      if (dry && this.playing) this.starve();
      if (!dry && this.playing) this.last = this.ring[this.read++ & (CAPACITY - 1)];
      const goal = this.playing ? 1 : 0;
      this.gain += Math.max(-1 / FADE, Math.min(1 / FADE, goal - this.gain));
      out[k] = this.last * this.gain;
    }
    this.played += out.length;
    if (this.played - this.calmSince > CALM_S * sampleRate) {
      this.wantedMs = Math.max(LEAST_MS, this.wantedMs - GROW_MS / 2);
      this.calmSince = this.played;
    }
    if (++this.quanta % REPORT_EVERY === 0) this.report();
    return true;
  }

  starve() {
    this.playing = false;
    this.gaps += 1;
    this.wantedMs = Math.min(MOST_MS, this.wantedMs + GROW_MS);
    this.calmSince = this.played;
  }

  report() {
    this.port.postMessage({ bufferMs: ((this.write - this.read) / sampleRate) * 1000, wantedMs: this.wantedMs, gaps: this.gaps, played: this.played / sampleRate });
  }
}

registerProcessor("vocalis-stream", Stream);
