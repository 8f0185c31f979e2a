"""The substitution `ThisLaunchFileDir`."""

from __future__ import annotations

from launch.launch_context import LaunchContext
from launch.substitution import Substitution, SubstitutionFailure


class ThisLaunchFileDir(Substitution):
    """The folder of the launch file that uses it."""

    def describe(self) -> str:
        """Work like `Substitution`."""
        return "ThisLaunchFileDir()"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        known = context.get_locals_as_dict()
        if "current_launch_file_directory" not in known:
            raise SubstitutionFailure("ThisLaunchFileDir used outside of a launch file (in a script)")
        return known["current_launch_file_directory"]
