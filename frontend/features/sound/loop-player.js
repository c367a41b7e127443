/** Plays a buffer: one Web Audio graph whose source is exchanged by a cross-fade. */

const CROSSFADE_S = 0.08;
const FULL_SCALE_PA = 2000; // modal voice at 1 kPa peaks near a quarter of this
const LINEAR_TO = 0.7;
const HEADROOM = 4;

export class LoopPlayer {
  #source = null;

  /** `context`: AudioContext or OfflineAudioContext. Graph: source → fade → volume → limiter → out. */
  constructor(context) {
    this.context = context;
    this.volume = context.createGain();
    const into = context.createGain();
    into.gain.value = 1 / HEADROOM;
    const limiter = context.createWaveShaper();
    limiter.curve = limiterCurve();
    this.volume.connect(into).connect(limiter).connect(context.destination);
  }

  setVolume(gain) {
    this.volume.gain.setTargetAtTime(gain, this.context.currentTime, 0.02);
  }

  /**
   * Play `pressure` in place of the present sound; null fades to silence.
   *
   * @param {Float32Array | null} pressure Pa, at the context's rate
   * @param {{loop?: boolean, ended?: () => void}} [options]
   */
  play(pressure, { loop = true, ended } = {}) {
    const now = this.context.currentTime;
    this.#fadeOut(now);
    if (pressure === null) return;
    const buffer = this.context.createBuffer(1, pressure.length, this.context.sampleRate);
    buffer.copyToChannel(
      pressure.map((v) => v / FULL_SCALE_PA),
      0,
    );
    const node = this.context.createBufferSource();
    node.buffer = buffer;
    node.loop = loop;
    if (ended) node.addEventListener("ended", ended);
    const fade = this.context.createGain();
    fade.gain.setValueAtTime(0, now);
    fade.gain.linearRampToValueAtTime(1, now + CROSSFADE_S);
    node.connect(fade).connect(this.volume);
    node.start(now);
    this.#source = { node, fade };
  }

  stop() {
    this.#fadeOut(this.context.currentTime);
  }

  #fadeOut(now) {
    if (!this.#source) return;
    const { node, fade } = this.#source;
    fade.gain.cancelScheduledValues(now);
    fade.gain.setValueAtTime(fade.gain.value, now);
    fade.gain.linearRampToValueAtTime(0, now + CROSSFADE_S);
    node.stop(now + CROSSFADE_S + 0.01);
    this.#source = null;
  }
}

/** Linear up to 0.7 of full scale, then a bend towards 0.95: a sudden loud voice cannot hurt. */
function limiterCurve() {
  const count = 4097;
  return Float32Array.from({ length: count }, (_, k) => {
    const x = HEADROOM * ((2 * k) / (count - 1) - 1);
    const size = Math.abs(x);
    const bent = size <= LINEAR_TO ? size : LINEAR_TO + 0.25 * Math.tanh((size - LINEAR_TO) / 0.25);
    return Math.sign(x) * bent;
  });
}
