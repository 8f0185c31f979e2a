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
STAMPS = ("CLASSROOM", "ASSIGNMENT", "ASSIGNMENT_TYPE", "USERNAME", "OWNER", "SUBMISSION_TAG", "COMMIT_URL")
STAMPS += ("RELEASE_URL", "REVIEW_URL")


def main() -> int:
    """Install, judge and write the files; returns the exit status."""
    root = [] if os.geteuid() == 0 else ["sudo", "-n"]
    if root and not shutil.which("sudo"):
        print("::error::The autograder needs root, or sudo without a password.", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as place:
        source = Path(place) / "source"  # root's, so that no student's process can change it
        subprocess.run([*root, "cp", "-R", str(HERE), str(source)], check=True)
        subprocess.run([*root, "sh", str(source / "install.sh"), str(PLACE)], check=True)
        stamps = [f"{name}={os.environ[name]}" for name in STAMPS if name in os.environ]
        judge = [str(PLACE / ".venv/bin/python"), "-P", "-m", RUN, "classroom50"]
        command = [*root, "env", "-C", str(source), *stamps, *judge, "--submission", os.getcwd()]
        done = subprocess.run(command)
        subprocess.run([*root, "chmod", "-R", "a+rX", os.path.join(os.getcwd(), "result.json")])
        subprocess.run([*root, "rm", "-rf", str(source)])
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
