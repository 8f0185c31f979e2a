"""The substitutions for the launch file that uses them: its path, and its folder."""

from __future__ import annotations

from launch.launch_context import LaunchContext
from launch.substitution import Substitution, SubstitutionFailure


class _OfThisLaunchFile(Substitution):
    local: str  # its name in the context

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"{type(self).__name__}()"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        known = context.get_locals_as_dict()
        if self.local not in known:
            raise SubstitutionFailure(f"{type(self).__name__} used outside of a launch file (in a script)")
        return known[self.local]


class ThisLaunchFile(_OfThisLaunchFile):
    """The path of the launch file that uses it."""

    local = "current_launch_file_path"


class ThisLaunchFileDir(_OfThisLaunchFile):
    """The folder of the launch file that uses it."""

    local = "current_launch_file_directory"
