"""Starts a user's JupyterLab as that Unix user, within the limits of the settings."""
import os
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from jupyterhub.spawner import LocalProcessSpawner

from grader.marking.extras.hub import leftovers, user_limits
from grader.marking.extras.hub.become_user import PRIVATE, hand_over, hide_others
from grader.marking.extras.hub.hub_settings import HubSettings
from grader.marking.extras.hub.server_environment import server_environment


class CourseSpawner(LocalProcessSpawner):  # type: ignore[misc]
    """One installation for all; a user's own files are in the home."""

    settings: HubSettings  # assigned in jupyterhub_config.py
    pid: int  # JupyterHub's trait

    def get_env(self) -> dict[str, str]:
        """The environment of the server: JupyterHub's, and where the course is."""
        usual: dict[str, str] = super().get_env()
        return usual | server_environment(self.settings, self.user.name)

    def load_state(self, state: dict[str, Any]) -> None:
        """Find a server that an earlier hub started, unless its number is another user's process by now."""
        super().load_state(state)
        if self.pid and not leftovers.is_process_of(self.pid, self.user.name):
            self.pid = 0

    def make_preexec_fn(self, name: str) -> Callable[[], None]:
        """Join the user's control group, hide what other users do, and become the user."""
        limits = self.settings.limits
        groups = user_limits.make_group(name, limits)
        become_user = super().make_preexec_fn(name)

        def prepare() -> None:
            user_limits.join(groups, limits)
            with suppress(PermissionError):  # machine.weaknesses names it
                hide_others()
            become_user()
            os.umask(PRIVATE)

        return prepare

    async def move_certs(self, paths: dict[str, str]) -> dict[str, str]:
        """Give the server its certificates."""
        return hand_over(paths, self.settings.certificates(self.user.name), self.user.name)

    async def stop(self, now: bool = False) -> Any:
        """End the server and what it started."""
        await super().stop(now)
        user_limits.end_group(self.user.name)
