"""What root does for a server before it runs as another user."""
import os
import pwd
import shutil
from collections.abc import Mapping
from pathlib import Path

PRIVATE = 0o077  # the umask: what a user makes, also in /tmp and /dev/shm, is for this user only


def hand_over(certificates: Mapping[str, str], folder: Path, name: str) -> dict[str, str]:
    """Copy a server's certificates into a folder that its user reads and only root writes.

    JupyterHub's own folder for them is in the home, where root would follow the user's links.
    """
    user = pwd.getpwnam(name)
    copies = {}
    for kind, path in certificates.items():
        copy = folder / Path(path).name
        copy.unlink(missing_ok=True)
        shutil.copyfile(path, copy)
        copy.chmod(0o400)
        os.chown(copy, user.pw_uid, user.pw_gid)
        copies[kind] = str(copy)
    return copies


def become_user(name: str) -> None:
    """Give up root's rights in this process, for good; what it makes is for the user only."""
    user = pwd.getpwnam(name)
    os.initgroups(name, user.pw_gid)
    os.setgid(user.pw_gid)
    os.setuid(user.pw_uid)
    os.umask(PRIVATE)
