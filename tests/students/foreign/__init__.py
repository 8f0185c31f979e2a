"""Right programs in styles that the course doesn't teach, each for a diagnosis that could mistake it."""

from tests.students.foreign import (
    conditions,
    driving,
    endings,
    executors,
    jazzy,
    later,
    legacy,
    libraries,
    partners,
    services,
    shapes,
    small,
    state,
    talking,
    waiting,
)

CORPUS = [
    *small.CORPUS,
    *shapes.CORPUS,
    *state.CORPUS,
    *legacy.CORPUS,
    *executors.CORPUS,
    *talking.CORPUS,
    *services.CORPUS,
    *driving.CORPUS,
    *waiting.CORPUS,
    *later.CORPUS,
    *conditions.CORPUS,
    *partners.CORPUS,
    *jazzy.CORPUS,
    *libraries.CORPUS,
    *endings.CORPUS,
]
