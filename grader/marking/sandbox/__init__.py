"""Runs students' code in processes that can reach only their own scratch folder and one socket."""

from grader.marking.sandbox.confined_process import ConfinedProcess
from grader.marking.sandbox.resource_limits import ProcessEnd, ResourceLimits
from grader.marking.sandbox.sandbox import Sandbox

__all__ = ["ConfinedProcess", "ProcessEnd", "ResourceLimits", "Sandbox"]
