"""Checks, and the measures that authors of exercises build them from: plain Python over recordings."""

from grader.checks.actions import (
    accepts,
    cancels,
    finishes,
    gives_feedback,
    rejects,
    sends_goals,
    serves_action,
)
from grader.checks.check import Check, Missed, check, hinting, otherwise, tenths
from grader.checks.control import (
    fell_at,
    keeps_deadline,
    keeps_to_limits,
    lean,
    overshoots,
    places,
    settles,
    stands,
    still_stands,
)
from grader.checks.joints import commands_within, draws, keeps_off, tip_at, tip_path
from grader.checks.logs import LogMatch, answers, come_every, logs
from grader.checks.mistakes import usual_mistake
from grader.checks.motion import (
    arrives,
    ends_with_a_stop,
    follows,
    has_no_contacts,
    keeps_clear,
    passes,
    stands_still,
    traveled,
    until_a_touch,
)
from grader.checks.nodes import has_timer, named, no_errors
from grader.checks.people import Encounter, nearest_person
from grader.checks.questions import Question, questions
from grader.checks.services import calls, course_calls, offers, responds, serves, wrong_response
from grader.checks.shift import Job, Shift, ShiftProgram, shift
from grader.checks.topics import lasts, publishes, rate, series, subscribes, within
from grader.checks.verdicts import Verdict, judge

__all__ = [
    "Check",
    "Encounter",
    "Job",
    "LogMatch",
    "Missed",
    "Question",
    "Shift",
    "ShiftProgram",
    "Verdict",
    "accepts",
    "answers",
    "arrives",
    "calls",
    "cancels",
    "check",
    "come_every",
    "commands_within",
    "course_calls",
    "draws",
    "ends_with_a_stop",
    "fell_at",
    "finishes",
    "follows",
    "gives_feedback",
    "has_no_contacts",
    "has_timer",
    "hinting",
    "judge",
    "keeps_clear",
    "keeps_deadline",
    "keeps_off",
    "keeps_to_limits",
    "lasts",
    "lean",
    "logs",
    "named",
    "nearest_person",
    "no_errors",
    "offers",
    "otherwise",
    "overshoots",
    "passes",
    "places",
    "publishes",
    "questions",
    "rate",
    "rejects",
    "responds",
    "sends_goals",
    "series",
    "serves",
    "serves_action",
    "settles",
    "shift",
    "stands",
    "stands_still",
    "still_stands",
    "subscribes",
    "tenths",
    "tip_at",
    "tip_path",
    "traveled",
    "until_a_touch",
    "usual_mistake",
    "within",
    "wrong_response",
]
