"""One visit to the page: actions and observations of a user."""

import re
from urllib.parse import urlsplit

SETTLED = "body[aria-busy=false] .phonation"
PICTURE = """name => {
  const canvas = document.querySelector(`canvas[data-picture="${name}"]`);
  return canvas.toDataURL();
}"""
#: Share of the pixels of a canvas that differ from its first one: 0 for an empty picture.
INK = """name => {
  const canvas = document.querySelector(`canvas[data-picture="${name}"]`);
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let different = 0;
  for (let k = 0; k < data.length; k += 4)
    if ([0, 1, 2, 3].some((c) => data[k + c] !== data[c])) different++;
  return (4 * different) / data.length;
}"""
#: Resolves once the expensive pictures show the newest voice, the view of the open tab has been loaded, and every
#: canvas has the size of its box, which it gets in the frame that paints it first.
PAINTED = """async () => {
  const [{ settled }, { result }] = await Promise.all([import("/state/settled.js"), import("/state/answers.js")]);
  const frame = () => new Promise(requestAnimationFrame);
  const ratio = Math.min(devicePixelRatio, 3);
  const fits = (canvas) => canvas.clientWidth < 2 || Math.abs(canvas.width - ratio * canvas.clientWidth) <= ratio;
  const painted = () => [...document.querySelectorAll("canvas.picture")].every(fits);
  const fetched = () => document.querySelector("[role=tabpanel] > *");
  while (settled.value !== result.value || !fetched() || !painted()) await frame();
}"""
FRAMES = "n => new Promise(done => { const f = () => (n-- > 0 ? requestAnimationFrame(f) : done()); f(); })"


class Visit:
    """``complaints``: console errors and warnings, exceptions. ``strangers``: requests to other origins."""

    def __init__(self, context, address: str, init: str = ""):
        self.context, self.address = context, address
        self.complaints: list[str] = []
        self.strangers: list[str] = []
        self.expected = re.compile(r"(?!)")  # complaints that a test expects
        self.page = context.new_page()
        self.page.set_default_timeout(20_000)
        self.page.on("console", self._hear)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", self._see)
        if init:
            self.page.add_init_script(init)

    def _hear(self, message) -> None:
        if message.type in ("error", "warning") and not self.expected.search(message.text):
            self.complaints.append(message.text)

    def _see(self, request) -> None:
        parts = urlsplit(request.url)
        if parts.scheme in ("http", "https", "ws", "wss") and parts.netloc != urlsplit(self.address).netloc:
            self.strangers.append(request.url)

    def open(self, query: str = "") -> None:
        self.page.goto(f"{self.address}/{query}")

    def settle(self) -> None:
        """Wait until the result of the current settings is painted."""
        self.page.wait_for_selector(SETTLED)
        self.page.evaluate(FRAMES, 3)

    def painted(self) -> None:
        """Wait until the slower pictures are painted as well, which happens once the controls rest."""
        self.settle()
        self.page.evaluate(PAINTED)
        self.page.evaluate(FRAMES, 3)

    def hold_still(self, phase: int = 300) -> None:
        """Stop the motion at a phase, in thousandths of the cycle."""
        self.page.locator(".scrub").fill(str(phase))
        self.page.evaluate(FRAMES, 3)

    def slider(self, path: str):
        return self.page.locator(f"#control-{path.replace('.', '-')}")

    def set(self, path: str, value: float) -> None:
        self.slider(path).fill(str(value))
        self.settle()

    def typed(self, name: str):
        return self.page.get_by_role("textbox", name=f"{name}, typed value")

    def picture(self, name: str) -> str:
        return self._of_picture(PICTURE, name)

    def ink(self, name: str) -> float:
        return self._of_picture(INK, name)

    def _of_picture(self, script: str, name: str):
        self.page.wait_for_selector(f"[data-picture={name}]", state="attached")
        return self.page.evaluate(script, name)

    def result_id(self) -> str:
        return self.page.locator(".strip").get_attribute("data-result")

    def api(self, path: str) -> dict:
        """A GET under /api/v1, as the page's own client."""
        return self.page.request.get(f"{self.address}/api/v1/{path}").json()

    def state(self) -> str:
        return self.page.locator(".phonation-state").inner_text()
