"""Reads a trace of Chromium: script time between one frame of the page and the next."""

SCRIPTS = {
    "EvaluateScript",
    "EventDispatch",
    "FireAnimationFrame",
    "FireIdleCallback",
    "FunctionCall",
    "MajorGC",
    "MinorGC",
    "RunMicrotasks",
    "TimerFire",
}
SCREEN_US = 1e6 / 60 - 500
FRAMES = {"AnimationFrame", "FireAnimationFrame"}
CATEGORIES = ["devtools.timeline"]


def scripts_of_frames(events: list[dict]) -> list[float]:
    """Script time of each frame, ms, on the thread that painted most frames."""
    frames: dict[tuple, list[float]] = {}
    for event in events:
        if event["name"] in FRAMES and event["ph"] in "bX":
            frames.setdefault((event["pid"], event["tid"]), []).append(event["ts"])
    thread, painted = max(frames.items(), key=lambda item: len(item[1]))
    starts = [min(painted)]
    for start in sorted(painted):  # a headless browser paints more often than a screen would
        if start - starts[-1] >= SCREEN_US:
            starts.append(start)
    spans = sorted(
        (event["ts"], event["ts"] + event["dur"])
        for event in events
        if (event["pid"], event["tid"]) == thread and event["name"] in SCRIPTS and event.get("ph") == "X"
    )
    spent = [0.0] * (len(starts) - 1)
    for begin, end in outermost(spans):
        for k, (first, last) in enumerate(zip(starts, starts[1:], strict=False)):
            spent[k] += max(0.0, min(end, last) - max(begin, first)) / 1e3
    return spent


def outermost(spans: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Spans that are not inside another one, so that nested calls count once."""
    joined: list[tuple[float, float]] = []
    for begin, end in spans:
        if joined and begin < joined[-1][1]:
            joined[-1] = (joined[-1][0], max(joined[-1][1], end))
        else:
            joined.append((begin, end))
    return joined
