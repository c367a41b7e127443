/**
 * The worker of a played voice. It carries sound from the socket to the worklet without a turn of the page's own
 * thread, so a page busy with painting causes no gap and does not delay a movement.
 *
 * Takes {open: {url, first, line}} once, where `line` is a port to the worklet, then {send: message} and {close:
 * true}. Posts {said: document} for every text frame of the server, {report} and {sounded: {stamp, at}} of the
 * worklet, and {ended: reason} once.
 */

const HEADER = 4; // uint32 sequence number
const REPORT_WAITS_MS = 25;

let socket = null;
let line = null;
const unsaid = []; // until the socket is open
let report = null; // of the worklet, until it is said: with the next movement, or alone when none comes
let heard = null; // the newest movement the server has heard: {stamp, sequence} of the first block that follows it

self.onmessage = ({ data: { open, send, close } }) => {
  if (open) begin(open);
  else if (send) say(withReport(send));
  else if (close) {
    socket.onclose = null;
    socket.close();
    self.close();
  }
};

function begin({ url, first, line: port }) {
  line = port;
  line.onmessage = ({ data }) => fromWorklet(data);
  socket = new WebSocket(url);
  socket.binaryType = "arraybuffer";
  unsaid.push(first);
  socket.onopen = () => unsaid.splice(0).forEach(say);
  socket.onmessage = ({ data }) => (typeof data === "string" ? hear(JSON.parse(data)) : play(data));
  socket.onclose = ({ reason }) => self.postMessage({ ended: reason });
}

function say(message) {
  if (socket.readyState === WebSocket.CONNECTING) unsaid.push(message);
  else socket.send(JSON.stringify(message));
}

function hear(document) {
  if (document.type === "heard") heard = document;
  else self.postMessage({ said: document });
}

function play(frame) {
  const samples = new Float32Array(frame, HEADER);
  const follows = heard && new DataView(frame).getUint32(0, true) >= heard.sequence;
  line.postMessage({ samples, mark: follows ? heard.stamp : undefined }, [frame]);
  if (follows) heard = null;
}

function fromWorklet({ mark, at, ...buffer }) {
  if (mark !== undefined) return self.postMessage({ sounded: { stamp: mark, at } });
  report = { buffer_ms: buffer.bufferMs, wanted_buffer_ms: buffer.wantedMs };
  setTimeout(() => report && say(withReport({})), REPORT_WAITS_MS); // every word of its own wakes the server
  self.postMessage({ report: buffer });
}

function withReport(message) {
  const both = { ...message, ...report };
  report = null;
  return both;
}
