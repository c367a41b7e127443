/** Loaded as a script when a figure first needs it. */
interface Window {
  Plotly: any;
}

/** A context that paints a file rather than the page: layers are painted again, not copied. */
interface CanvasRenderingContext2D {
  isFigure?: boolean;
}

// The scope of an audio worklet, which TypeScript's own libraries do not describe.
declare class AudioWorkletProcessor {
  readonly port: MessagePort;
}
declare const sampleRate: number;
declare const currentTime: number;
declare function registerProcessor(name: string, processor: new () => AudioWorkletProcessor): void;
