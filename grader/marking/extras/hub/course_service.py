"""Starts the server on which the teachers of a course mark it.

JupyterHub runs `python -m grader.marking.extras.hub.course_service SETTINGS COURSE` as root.
"""
import os
import sys
from pathlib import Path

from grader.marking.extras.hub.become_user import become_user, hand_over
from grader.marking.extras.hub.hub_settings import grader_of, read_settings
from grader.marking.extras.hub.server_environment import service_environment

VARIABLES = ("JUPYTERHUB_SSL_KEYFILE", "JUPYTERHUB_SSL_CERTFILE", "JUPYTERHUB_SSL_CLIENT_CA")


def main(arguments: list[str]) -> None:
    """Run JupyterLab as the course's grader, in place of this process."""
    file, course = arguments
    settings, grader = read_settings(Path(file)), grader_of(course)
    given = {name: path for name in VARIABLES if (path := os.environ.get(name))}
    environment = {
        **os.environ,
        **hand_over(given, settings.certificates(course), grader),
        **service_environment(settings, course),
    }
    become_user(grader)
    os.chdir(settings.course_folder(course))
    program = str(settings.installation / ".venv" / "bin" / "jupyterhub-singleuser")
    os.execve(program, [program], environment)


if __name__ == "__main__":
    main(sys.argv[1:])
