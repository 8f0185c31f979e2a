#!/usr/bin/env python3
"""The autograder of an assignment for Classroom 50: it judges the student's checkout, its working folder.

In its folder are the course, wheels and settings. It writes result.json and release-body.md. Its exit status
is 0 if a verdict was reached. It needs root, or `sudo` without a password.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(os.environ.get("CLASSROOM50_BUNDLE_DIR") or Path(__file__).resolve().parent)
PLACE = Path("/opt/ros2-course")
RUN = "grader.marking.extras.platforms.run"
STAMPS: tuple[str, ...] = ("CLASSROOM", "ASSIGNMENT", "ASSIGNMENT_TYPE", "USERNAME", "OWNER")
STAMPS += ("SUBMISSION_TAG", "COMMIT_URL", "RELEASE_URL", "REVIEW_URL")
WRITTEN = ("result.json", "release-body.md")


def main() -> int:
    """Install, judge and write the files; returns the exit status."""
    root = [] if os.geteuid() == 0 else ["sudo", "-n"]
    if root and (not shutil.which("sudo") or subprocess.run([*root, "true"], capture_output=True).returncode):
        return failed("expected root, or sudo without a password")
    with tempfile.TemporaryDirectory() as place:
        source = Path(place) / "source"  # root's, so that no student's process can change it
        try:
            return judge(root, source)
        finally:
            subprocess.run([*root, "rm", "-rf", str(source)])


def judge(root: list[str], source: Path) -> int:
    """Judge with a copy of the autograder in `source`; returns the exit status."""
    install = [*root, "sh", str(source / "install.sh"), str(PLACE)]
    for command in ([*root, "cp", "-R", str(HERE), str(source)], install):
        status = subprocess.run(command).returncode
        if status:
            return failed(f"it could not be installed here: status {status} of `{' '.join(command)}`")
    stamps = [f"{name}={os.environ[name]}" for name in STAMPS if name in os.environ]
    command = ["env", "-C", str(source), *stamps, str(PLACE / ".venv/bin/python"), "-P", "-m", RUN]
    done = subprocess.run([*root, *command, "classroom50", "--submission", os.getcwd()])
    written = [name for name in WRITTEN if Path(name).is_file()]
    if written:  # Classroom 50 completes them, as the user who runs this
        subprocess.run([*root, "chown", f"{os.getuid()}:{os.getgid()}", *written], check=True)
    return done.returncode


def failed(why: str) -> int:
    """Say why nothing was judged, as GitHub shows it; returns the exit status."""
    print(f"::error::The autograder did not judge: {why}.", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
