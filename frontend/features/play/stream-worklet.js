/**
 * Plays blocks of sound from the smallest buffer that the connection allows. It fades out when the buffer is empty and
 * fades in when sound arrives again, so there is never a click.
 *
 * It controls the low-water mark: the smallest fill since the last report, as the median of the last few reports, so
 * that one short dip does not ask for a larger buffer. The target leaves SAFETY_MS after the deepest dip of the last
 * half minute, and is never below LEAST_MS. A machine whose threads wake late does so about every ten seconds, so a
 * shorter memory would let the buffer run dry. The server sends a little faster or slower until the target is reached.
 *
 * The port of the node takes {line}: the port on which blocks arrive as {samples, mark}, and on which the reports
 * {bufferMs, wantedMs, gaps, played} and {mark, at} (the context's time at which a marked block begins) leave.
 */

const FADE = 240; // samples, 5 ms at 48 kHz
const CAPACITY = 1 << 15;
const LEAST_MS = 30; // the least for a page that paints on two cores
const FIRST_MS = 34;
const MOST_MS = 200;
const SAFETY_MS = 6;
const GROW_MS = 16; // after a gap, as the depth of its dip is unknown
const SHRINK_MS = 4;
const WATCH_REPORTS = 80; // 5 s: a period whose deepest dip is remembered
const REMEMBERED = 6; // periods
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
    this.dips = []; // the deepest of each earlier period
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
    // On top of the low-water mark: one whole block plays before the next one arrives.
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
