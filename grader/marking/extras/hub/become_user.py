"""What root does for a server before it runs as another user."""
import os
import pwd
import shutil
from collections.abc import Mapping
from pathlib import Path

from grader.marking.sandbox import linux

TEMPORARY = ("/tmp", "/var/tmp", "/dev/shm")
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


def hide_others() -> None:
    """Give this process temporary folders of its own, and a /proc that shows the processes of its user only.

    Files there are in memory, within the limit of the user, and end with the server. Raises PermissionError
    where root may not do that, as in many containers.
    """
    linux.unshare(linux.NEW_MOUNT)
    linux.mount("", "/", flags=linux.MS_REC | linux.MS_SLAVE)  # homes that are mounted later still appear
    for folder in TEMPORARY:
        linux.mount("private", folder, "tmpfs", linux.MS_NOSUID | linux.MS_NODEV, "mode=1777")
    linux.mount("proc", "/proc", "proc", linux.MS_NOSUID | linux.MS_NODEV | linux.MS_NOEXEC, "hidepid=2")


def become_user(name: str) -> None:
    """Give up root's rights in this process, for good; what it makes is for the user only."""
    user = pwd.getpwnam(name)
    os.initgroups(name, user.pw_gid)
    os.setgid(user.pw_gid)
    os.setuid(user.pw_uid)
    os.umask(PRIVATE)
