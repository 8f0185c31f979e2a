"""Runs students' code in processes that reach nothing but their own scratch folder and one socket."""

from grader.marking.sandbox.errors import SandboxFailed, SandboxMissing
from grader.marking.sandbox.inmate import Inmate
from grader.marking.sandbox.limits import Ending, Limits
from grader.marking.sandbox.sandbox import Sandbox

__all__ = ["Ending", "Inmate", "Limits", "Sandbox", "SandboxFailed", "SandboxMissing"]
