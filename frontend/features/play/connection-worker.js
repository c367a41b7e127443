/**
 * The worker of a played voice. It carries sound from the socket to the worklet without a turn of the page's own
 * thread, so a page busy with painting causes no gap and does not delay a movement.
 *
 * Takes {open: {url, first, worklet}} once, where `worklet` is a port to it, then {send: message} and {close:
 * true}. Posts {received: document} for every text frame of the server, {report} and {sounded: {stamp, at}} of the
 * worklet, and {ended: reason} once.
 */

const HEADER = 4; // uint32 sequence number
const REPORT_WAITS_MS = 25;

let socket = null;
let worklet = null;
const unsent = []; // until the socket is open
let report = null; // the worklet's report, until it is sent: with the next change, or alone if none comes
let taken = null; // the newest change that the server has taken: {stamp, sequence} of the first block that follows it

self.onmessage = ({ data: { open, send: message, close } }) => {
  if (open) begin(open);
  else if (message) send(withReport(message));
  else if (close) {
    socket.onclose = null;
    socket.close();
    self.close();
  }
};

function begin({ url, first, worklet: port }) {
  worklet = port;
  worklet.onmessage = ({ data }) => fromWorklet(data);
  socket = new WebSocket(url);
  socket.binaryType = "arraybuffer";
  unsent.push(first);
  socket.onopen = () => unsent.splice(0).forEach(send);
  socket.onmessage = ({ data }) => (typeof data === "string" ? receive(JSON.parse(data)) : play(data));
  socket.onclose = ({ reason }) => self.postMessage({ ended: reason });
}

function send(message) {
  if (socket.readyState === WebSocket.CONNECTING) unsent.push(message);
  else socket.send(JSON.stringify(message));
}

function receive(document) {
  if (document.type === "heard") taken = document;
  else self.postMessage({ received: document });
}

function play(frame) {
  const samples = new Float32Array(frame, HEADER);
  const follows = taken && new DataView(frame).getUint32(0, true) >= taken.sequence;
  worklet.postMessage({ samples, mark: follows ? taken.stamp : undefined }, [frame]);
  if (follows) taken = null;
}

function fromWorklet({ mark, at, ...buffer }) {
  if (mark !== undefined) return self.postMessage({ sounded: { stamp: mark, at } });
  report = { buffer_ms: buffer.bufferMs, wanted_buffer_ms: buffer.wantedMs };
  setTimeout(() => report && send(withReport({})), REPORT_WAITS_MS); // each message wakes the server
  self.postMessage({ report: buffer });
}

function withReport(message) {
  const both = { ...message, ...report };
  report = null;
  return both;
}
