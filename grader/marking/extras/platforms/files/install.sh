#!/bin/sh
# Install the autograder from this folder into a container: sh install.sh [FOLDER]     default: /opt/ros2-course
# No compiler is needed. Where wheels/ has all packages, no network is needed either.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
place=${1:-/opt/ros2-course}

supported() {
    "$1" -c 'import ensurepip, sys, venv; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))' 2>/dev/null
}

find_python() {
    for name in ${PYTHON:-} python3.12 python3.13 python3.14 python3.11 python3; do
        if supported "$name"; then
            echo "$name"
            return
        fi
    done
}

python=$(find_python)
if [ -z "$python" ] && command -v apt-get >/dev/null; then
    apt-get update -q
    for version in 3.12 3.11; do
        if apt-get install -q -y --no-install-recommends "python$version" "python$version-venv"; then
            break
        fi
    done
    python=$(find_python)
fi
if [ -z "$python" ]; then
    echo "No Python 3.11 to 3.14 with venv can be had here: choose a newer base image." >&2
    exit 1
fi

mkdir -p "$place"
"$python" -m venv "$place/.venv"
pip() {
    "$place/.venv/bin/python" -m pip --disable-pip-version-check "$@"
}
pip install --quiet --no-deps --find-links "$here/wheels" --requirement "$here/requirements.txt"
pip install --quiet --no-deps --no-index "$here"/wheels/ros2_course_*.whl
rm -rf "$place/course"
cp -R "$here/course" "$place/course"
packages=$("$place/.venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
printf '%s\n' "$place/course" "$place/course/ros_packages/python" >"$packages/ros2_course.pth"
# bubblewrap is used where the container allows namespaces; elsewhere students' processes are other users.
if ! command -v bwrap >/dev/null && command -v apt-get >/dev/null; then
    { apt-get update -q && apt-get install -q -y --no-install-recommends bubblewrap; } || true
fi
"$place/.venv/bin/python" -m compileall -q "$place/course" || true
# These read the course without what stays with the judge, and nothing of this folder.
chmod -R a+rX "$place"
chmod -R go-rwx "$here"
cd /
"$place/.venv/bin/python" -P - <<'PYTHON'
from grader.marking.student_process.judge_only import FOLDERS

for folder in FOLDERS:
    folder.chmod(0o700)
PYTHON
echo "The autograder is in $place."
