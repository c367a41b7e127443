/**
 * Plays blocks of sound as they come, from as small a buffer as the line allows. Falls silent and comes back by fading,
 * never by a click.
 *
 * What is kept in step is the low water: the least that waited since the last report, the middle of the last few reports,
 * for a dip that has passed must not call for more. It is wanted where the deepest dip of the last half minute would
 * still leave SAFETY_MS, and never below LEAST_MS: a machine whose threads wake late does so every ten seconds or so, and
 * a buffer that has forgotten it by then runs dry. The server sends a little faster or slower until it is there.
 *
 * The node's own port takes {line}: the port that blocks come through as {samples, mark}, and that reports
 * {bufferMs, wantedMs, gaps, played} and {mark, at} (the context's time at which a marked block begins) go back to.
 */

const FADE = 240; // samples, 5 ms at 48 kHz
const CAPACITY = 1 << 15;
const LEAST_MS = 30; // what a page that paints on two cores needs even in calm
const FIRST_MS = 34;
const MOST_MS = 200;
const SAFETY_MS = 6;
const GROW_MS = 16; // after a gap: how deep the dip would have been, nobody knows
const SHRINK_MS = 4;
const WATCH_REPORTS = 80; // 5 s: a stretch of which the deepest dip is kept
const REMEMBERED = 6; // stretches
const MIDDLE_OF = 5; // reports
const REPORT_EVERY = 24; // quanta of 128 samples: 64 ms

class Stream extends AudioWorkletProcessor {
  constructor() {
    super();
    this.ring = new Float32Array(CAPACITY);
    this.read = 0;
    this.write = 0;
    this.marks = []; // [place in the ring, mark]
    this.playing = false;
    this.gain = 0;
    this.last = 0;
    this.wantedMs = FIRST_MS;
    this.low = Infinity;
    this.lows = [];
    this.deepestMs = 0;
    this.dips = []; // the deepest of the stretches before
    this.reports = 0;
    this.gaps = 0;
    this.played = 0;
    this.quanta = 0;
    this.port.onmessage = ({ data: { line } }) => {
      this.line = line;
      line.onmessage = ({ data }) => this.take(data);
    };
  }

  take({ samples, mark }) {
    if (mark !== undefined) this.marks.push([this.write, mark]);
    for (let k = 0; k < samples.length; k++) this.ring[(this.write + k) & (CAPACITY - 1)] = samples[k];
    this.write += samples.length;
    if (this.write - this.read > CAPACITY) this.read = this.write - CAPACITY;
    // Beyond the low water a whole block goes out before the next one comes.
    if (this.write - this.read >= (this.wantedMs * sampleRate) / 1000 + samples.length) this.playing = true;
  }

  process(_, [[out]]) {
    const begin = this.read;
    for (let k = 0; k < out.length; k++) {
      const dry = this.read >= this.write;
      if (dry && this.playing) this.starve();
      if (!dry && this.playing) this.last = this.ring[this.read++ & (CAPACITY - 1)];
      const goal = this.playing ? 1 : 0;
      this.gain += Math.max(-1 / FADE, Math.min(1 / FADE, goal - this.gain));
      out[k] = this.last * this.gain;
    }
    while (this.marks.length && this.marks[0][0] < this.read) {
      const [place, mark] = this.marks.shift();
      this.line.postMessage({ mark, at: currentTime + Math.max(0, place - begin) / sampleRate });
    }
    this.played += out.length;
    if (this.playing) this.low = Math.min(this.low, this.write - this.read);
    if (++this.quanta % REPORT_EVERY === 0 && this.low < Infinity) this.report();
    return true;
  }

  starve() {
    this.playing = false;
    this.gaps += 1;
    this.wantedMs = Math.min(MOST_MS, this.wantedMs + GROW_MS);
  }

  report() {
    const lowMs = (this.low / sampleRate) * 1000;
    this.low = Infinity;
    this.lows = [...this.lows.slice(1 - MIDDLE_OF), lowMs];
    const bufferMs = this.lows.toSorted((a, b) => a - b)[this.lows.length >> 1];
    this.line.postMessage({ bufferMs, wantedMs: this.wantedMs, gaps: this.gaps, played: this.played / sampleRate });
    this.deepestMs = Math.max(this.deepestMs, this.wantedMs - lowMs);
    const enough = Math.min(MOST_MS, Math.max(LEAST_MS, Math.max(this.deepestMs, ...this.dips) + SAFETY_MS));
    this.wantedMs = Math.max(this.wantedMs, enough);
    if (++this.reports % WATCH_REPORTS) return;
    this.wantedMs = Math.max(enough, this.wantedMs - SHRINK_MS);
    this.dips = [...this.dips.slice(1 - REMEMBERED), this.deepestMs];
    this.deepestMs = 0;
  }
}

registerProcessor("vocalis-stream", Stream);
