"""The forms of the step in the voice process: loaded by threads of their own, compiled outside the process.

A voice whose folds begin to differ needs another form. Until that is loaded it goes on in the one it has.
"""

import logging
import threading
from typing import NamedTuple

from vfcore.fold.form import StepForm
from vfcore.runs.gesture import forms
from vocalis.server.warmup.form import compile_outside
from vocalis.server.warmup.requests import FORMS_AHEAD

log = logging.getLogger("vocalis")
_one_at_a_time = threading.Lock()


def load(form: StepForm) -> None:
    """Load a form; returns when a voice can march it at once."""
    if forms.is_loaded(form):
        return
    with _one_at_a_time:
        if not forms.is_compiled(form) and not compile_outside(form):
            log.warning("a form of the step could not be compiled outside the voice process: voices may have gaps")
        forms.load(form)


class Loading(NamedTuple):
    """A form, and the thread that loads it."""

    form: StepForm
    thread: threading.Thread


def load_in_thread(form: StepForm) -> Loading:
    """Start to load a form."""
    thread = threading.Thread(target=load, args=(form,), name="form", daemon=True)
    thread.start()
    return Loading(form, thread)


def load_compiled() -> None:
    """Load the forms that users meet first, those that are compiled."""
    for request in FORMS_AHEAD:
        form = forms.form_of(request)
        if forms.is_compiled(form):
            load(form)
