"""Stimulus and response: what the course sends, what must come back, and within which time.

A stimulus is a message, request or goal that a program of the course sends. The response is what the
student's programs publish within its window. Checks compare the two, and raise `Missed` if they differ.
"""

from grader.responses.comparison import listed, matches, numbers_in, same, states, text_of
from grader.responses.lost_transforms import stands_without_transforms
from grader.responses.speeds import Speed, closest, require_standing, speeds, top_speed
from grader.responses.stimuli import (
    Stimuli,
    Stimulus,
    from_course,
    from_student,
    last_before,
    requests_from_course,
)
from grader.responses.window import EDGE, Window

__all__ = [
    "EDGE", "Speed", "Stimuli", "Stimulus", "Window", "closest", "from_course", "from_student", "last_before",
    "listed", "matches", "numbers_in", "requests_from_course", "require_standing", "same", "speeds",
    "stands_without_transforms", "states", "text_of", "top_speed",
]
