"""Other machines and users than the one who tests."""
import os
import subprocess
import sys
import textwrap


def in_a_system_with(namespaces: int, script: str) -> subprocess.CompletedProcess:
    """Run Python code where at most so many user namespaces can be made. The code may change the number."""
    limited = f'echo {namespaces} > /proc/sys/user/max_user_namespaces; exec "$@"'
    return _run(["unshare", "--user", "--map-root-user", "sh", "-c", limited, "sh"], script)


def as_an_ordinary_user(script: str) -> subprocess.CompletedProcess:
    """Run Python code as one, who may read Python even if it is in root's folder."""
    if os.getuid():
        return _run([], script)
    open_home = (
        "mount --bind /root /mnt && mount -t tmpfs none /root && chmod 755 /root && mkdir /root/.pyenv"
        ' && if [ -d /mnt/.pyenv ]; then mount --bind /mnt/.pyenv /root/.pyenv; fi && exec "$@"'
    )
    drop = ["setpriv", "--reuid", "12345", "--regid", "12345", "--clear-groups"]
    return _run(["unshare", "--mount", "sh", "-c", open_home, "sh", *drop], script)


def _run(before: list[str], script: str) -> subprocess.CompletedProcess:
    command = [*before, sys.executable, "-c", textwrap.dedent(script)]
    return subprocess.run(command, capture_output=True, text=True)
