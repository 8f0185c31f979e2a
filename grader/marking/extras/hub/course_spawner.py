"""Starts a user's JupyterLab as that Unix user, within the limits of the settings."""
import os
from collections.abc import Callable
from typing import Any

from jupyterhub.spawner import LocalProcessSpawner

from grader.marking.extras.hub import user_limits
from grader.marking.extras.hub.become_user import PRIVATE, hand_over
from grader.marking.extras.hub.hub_settings import HubSettings
from grader.marking.extras.hub.server_environment import server_environment


class CourseSpawner(LocalProcessSpawner):
    """One installation for all; a user's own files are in the home."""

    settings: HubSettings  # assigned in jupyterhub_config.py

    def get_env(self) -> dict[str, str]:
        """The environment of the server: JupyterHub's, and where the course is."""
        return super().get_env() | server_environment(self.settings, self.user.name)

    def make_preexec_fn(self, name: str) -> Callable[[], None]:
        """Join the user's control group and become the user."""
        limits = self.settings.limits
        groups = user_limits.make_group(name, limits)
        become_user = super().make_preexec_fn(name)

        def prepare() -> None:
            user_limits.join(groups, limits)
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
