"""Files appear whole or not at all: written in the same folder under another name, then renamed."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacing(path: str | os.PathLike) -> Iterator[Path]:
    """A path to write to in the same folder as ``path``; renamed to it on success, removed on failure.

    Raises OSError when the folder does not exist or cannot be written.
    """
    target = Path(path)
    # A file in a new folder, unlike that of mkstemp, gets its permissions from the umask.
    with tempfile.TemporaryDirectory(prefix=f".{target.name}.", dir=target.parent) as folder:
        draft = Path(folder) / target.name
        yield draft
        os.replace(draft, target)


def write_bytes(path: str | os.PathLike, content: bytes) -> None:
    """Write ``content`` to ``path`` whole; OSError as for ``replacing``."""
    with replacing(path) as draft:
        draft.write_bytes(content)
