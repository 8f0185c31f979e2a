"""The sliders of a lesson on the web site, where no kernel runs: they show what was recorded for some values.

The kernel of a site's build calls `record_sliders` when it starts.
"""
import base64
import html
from collections.abc import Callable, Iterator
from importlib.resources import files
from typing import Any

import ipywidgets
from IPython.core.display import HTML
from IPython.display import display
from IPython.utils.capture import RichOutput, capture_output

ONE, EACH = 12, 5  # values of a slider that is alone, and of each of several
SCRIPT = files("grader.marking.release").joinpath("site_sliders.js").read_text(encoding="utf-8")
NOTE = "Recorded for {} values. In the course, each value runs your program again."
ONE_AT_A_TIME = " Here one slider moves at a time: the others go back to their start."


def record_sliders() -> None:
    """Let `interact` of ipywidgets record what its function shows, and wait for no slider to move."""
    ipywidgets.interact = recorded


def recorded(function: Callable[..., Any] | None = None, /, **sliders: Any) -> Callable[..., Any]:
    """Work like ipywidgets' `interact` with sliders: called with a function, or as its decorator."""
    if function is None:
        return lambda given: recorded(given, **sliders)
    start = {name: slider.value for name, slider in sliders.items()}
    outcomes, rows = [_outcome(function, start)], []  # the first outcome is that of the start
    for name, slider in sliders.items():
        cases = []
        for value in sampled(slider, ONE if len(sliders) == 1 else EACH):
            cases.append((value, 0 if value == slider.value else len(outcomes)))
            if value != slider.value:
                outcomes.append(_outcome(function, start | {name: value}))
        rows.append(_row(slider.description or name, cases))
    note = NOTE.format(len(outcomes)) + (ONE_AT_A_TIME if len(sliders) > 1 else "")
    recordings = "".join(f"<template>{outcome}</template>" for outcome in outcomes)
    page = f'{"".join(rows)}<p>{note}</p>{recordings}<div class="outcome"></div>'
    display(HTML(f'<div class="ros2-recorded">{page}</div><script>{SCRIPT}</script>'))
    return function


def sampled(slider: Any, most: int) -> list[float]:
    """At most this many values of a slider, evenly spaced, with its start among them."""
    last = round((slider.max - slider.min) / slider.step)
    start = round((slider.value - slider.min) / slider.step)
    stride = -(-last // (most - 1))
    values = (slider.min + step * slider.step for step in range(start % stride, last + 1, stride))
    return [slider.value if round(value, 9) == slider.value else round(value, 9) for value in values]


def _row(name: str, cases: list[tuple[float, int]]) -> str:
    """A slider. cases: each value with the number of its outcome."""
    at = next(index for index, (_, outcome) in enumerate(cases) if not outcome)
    numbers = " ".join(str(outcome) for _, outcome in cases)
    values = " ".join(f"{value:g}" for value, _ in cases)
    given = f'min="0" max="{len(cases) - 1}" value="{at}" data-outcomes="{numbers}" data-values="{values}"'
    return f'<label><span>{html.escape(name)}</span><input type="range" {given}><output></output></label>'


def _outcome(function: Callable[..., Any], values: dict[str, float]) -> str:
    """Return what the function prints and displays, as HTML."""
    with capture_output() as captured:
        function(**values)
    printed = f"<pre>{html.escape(captured.stdout)}</pre>" if captured.stdout else ""
    return printed + "".join(_shown(captured.outputs))


def _shown(outputs: list[RichOutput]) -> Iterator[str]:
    for output in outputs:
        if "text/html" in output.data:
            yield output.data["text/html"]
        elif "image/png" in output.data:
            picture, about = output.data["image/png"], output.metadata.get("image/png", {}).get("alt", "")
            text = picture if isinstance(picture, str) else base64.b64encode(picture).decode()
            yield f'<img src="data:image/png;base64,{text}" alt="{html.escape(about)}">'
        else:
            yield f"<pre>{html.escape(output.data.get('text/plain', ''))}</pre>"
