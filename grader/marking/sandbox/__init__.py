"""Runs students' code in processes that reach nothing but their own scratch folder and one socket."""

from grader.marking.sandbox.confined_process import ConfinedProcess
from grader.marking.sandbox.limits import Ending, Limits
from grader.marking.sandbox.sandbox import Sandbox

__all__ = ["ConfinedProcess", "Ending", "Limits", "Sandbox"]
