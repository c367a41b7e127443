"""Mixed load: single runs and overlapping sweeps, submitted continuously by a client that is sometimes disconnected."""

import random
import threading
import time
from contextlib import suppress
from uuid import uuid4

import httpx


class Load(threading.Thread):
    """Submits jobs continuously; ``accepted`` holds those with a 202 answer."""

    def __init__(self, client: httpx.Client, seed: int):
        super().__init__(daemon=True)
        self._client, self._random = client, random.Random(seed)
        self.accepted: dict[str, dict] = {}  # id -> body
        self.keys: dict[str, str] = {}
        self.dismissed: set[str] = set()
        self.doubled = 0
        self.end = threading.Event()

    def run(self) -> None:
        while not self.end.is_set():
            body, key = self._body(), uuid4().hex
            job = self._hand_in(body, key)
            if job is not None:
                self._note(job, body, key)
                if self._random.random() < 0.1:
                    self._dismiss(job)
            self.end.wait(self._random.uniform(0.05, 0.4))

    def _hand_in(self, body: dict, key: str) -> dict | None:
        """Retry with the same key until there is an answer."""
        while not self.end.is_set():
            with suppress(httpx.TransportError):
                answer = self._client.post("/jobs", json=body, headers={"Idempotency-Key": key})
                if answer.status_code == 202:
                    return answer.json()
            time.sleep(0.1)
        return None

    def _note(self, job: dict, body: dict, key: str) -> None:
        self.accepted[job["id"]] = body
        self.keys[key] = job["id"]
        old = self._random.choice(list(self.keys))
        with suppress(httpx.TransportError):
            headers = {"Idempotency-Key": old}
            again = self._client.post("/jobs", json=self.accepted[self.keys[old]], headers=headers)
            if again.status_code == 202:
                self.doubled += again.json()["id"] != self.keys[old]

    def _dismiss(self, job: dict) -> None:
        with suppress(httpx.TransportError):
            if self._client.delete(f"/jobs/{job['id']}").status_code == 200:
                self.dismissed.add(job["id"])

    def _body(self) -> dict:
        roll = self._random.choice
        run = {"duration_s": roll([0.1, 0.2, 0.3])}
        if self._random.random() < 0.6:
            return {"activation": {"ct": self._random.randrange(50) / 50}, "vowel": roll("aiu"), "run": run}
        first = self._random.randrange(60)
        values = [k / 100 for k in range(first, first + self._random.randrange(10, 40))]
        return {"kind": "sweep", "base": {"run": run}, "axes": [{"parameter": "activation.ta", "values": values}]}
