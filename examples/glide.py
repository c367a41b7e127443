"""A gesture: CT rises while the folds vibrate. Prints the pitch contour; writes glide.wav to the current directory."""

from pathlib import Path

from vfcore.io.audio import to_wav_bytes
from vfcore.runs.gesture.gesture import gesture_from_dict
from vfcore.runs.gesture.render import render

# A list of [time in s, value] may replace a number of a request.
gesture = gesture_from_dict({"activation": {"ct": [[0.2, 0.1], [0.8, 0.9]]}, "run": {"duration_s": 1.0}})
rendered = render(gesture)

contours = rendered.contours
for k in range(9, contours["time_s"].size, 20):
    print(f"{contours['time_s'][k]:.2f} s: CT {contours['activation.ct'][k]:.2f}, f_o {contours['fo_hz'][k]:.1f} Hz")

wav, _gain = to_wav_bytes(rendered.audio_pa)
Path("glide.wav").write_bytes(wav)
