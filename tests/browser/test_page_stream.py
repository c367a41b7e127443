"""The target of the audio buffer: higher for half a minute after a dip, then lower again."""

from pathlib import Path

import pytest

WORKLET = Path(__file__).parents[2] / "frontend/features/play/stream-worklet.js"
#: Runs the code of the worklet without a loudspeaker for each part (seconds, dip in ms) of ``story``. The buffer is
#: kept one block above its target, except for one dip in each part. Returns the target at the end of each part, and the
#: number of gaps.
PLAY = """story => {
  let Player;
  const sampleRate = 48000, currentTime = 0;
  class AudioWorkletProcessor { port = { postMessage() {} }; }
  const registerProcessor = (_, found) => { Player = found; };
  %s
  const stream = new Player();
  stream.line = { postMessage() {} };
  const out = new Float32Array(128);
  const fill = (ms) => {
    while (stream.write - stream.read < ms * 48) stream.take({ samples: new Float32Array(480) });
  };
  return story.map(([seconds, dipMs]) => {
    for (let k = 0; k < seconds * 375; k++) {
      fill(stream.wantedMs + 10);
      if (k === 40 && dipMs) stream.read = stream.write - 48 * Math.max(0, Math.round(stream.wantedMs - dipMs)) - 128;
      if (k === 40 && dipMs > stream.wantedMs) stream.read = stream.write;
      stream.process([], [[out]]);
    }
    return [stream.wantedMs, stream.gaps];
  });
}"""


@pytest.fixture
def stream(chromium):
    page = chromium.new_page()
    yield lambda *story: page.evaluate(PLAY % WORKLET.read_text(), [list(part) for part in story])
    page.close()


def test_after_a_dip_the_buffer_target_is_raised_for_half_a_minute_and_then_falls_slowly(stream):
    calm, dipped, later, after, long_after = stream((20, 0), (1, 29), (20, 0), (25, 0), (60, 0))
    assert calm == [30, 0]
    assert dipped == [pytest.approx(35, abs=3), 0], "an equal dip would leave a reserve"
    assert later == dipped
    assert 30 <= after[0] < later[0]
    assert long_after == [30, 0]


def test_after_a_gap_the_buffer_target_rises(stream):
    (_, before), (wanted, gaps) = stream((6, 0), (2, 60))
    assert before == 0 and gaps == 1
    assert 46 <= wanted <= 80


def test_the_buffer_target_has_an_upper_limit(stream):
    assert max(wanted for wanted, _ in stream(*[(2, 400)] * 30)) <= 200
