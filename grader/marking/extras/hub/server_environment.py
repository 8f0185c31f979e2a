"""The environment variables and arguments of the servers that a hub starts."""
import os

from grader.marking.extras.hub.hub_settings import HubSettings

SYSTEM = ("/usr/local/bin", "/usr/bin", "/bin")


def server_environment(settings: HubSettings, user: str) -> dict[str, str]:
    """For a user's own server: the students' course, and the user's own ROS domain."""
    return _common(settings, settings.installation / "jupyter", "hub") | {
        "JUPYTER_RUNTIME_DIR": str(settings.runtime(user)),
        "ROS2_HUB_COURSE": settings.students.get(user, ""),  # for jupyter/hub/nbgrader_config.py
        "ROS_DOMAIN_ID": str(settings.domain(user)),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }


def server_arguments(idle_kernel_minutes: float) -> list[str]:
    """For a user's own server: it ends kernels in which nothing has run for so long, also if a page is open.

    A cell that runs is activity, and so are the frames of a robot that `play` shows.
    """
    options = {"idle_timeout": round(60 * idle_kernel_minutes), "interval": 10, "connected": True}
    return [f"--MappingKernelManager.cull_{name}={value}" for name, value in options.items()]


def service_environment(settings: HubSettings, course: str) -> dict[str, str]:
    """For the server on which the teachers of a course mark it: the course with its solutions."""
    folder = settings.course_folder(course)
    return _common(settings, folder / "jupyter", "hub/teach", "teach") | {
        "JUPYTER_RUNTIME_DIR": str(settings.runtime(course)),
        "HOME": str(settings.home(course)),
        "PYTHONPATH": str(folder),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
    }


def _common(settings: HubSettings, jupyter: os.PathLike[str], *parts: str) -> dict[str, str]:
    folders = [os.path.join(jupyter, part) for part in parts]
    if "teach" not in parts:
        folders.append(os.fspath(jupyter))
    return {
        "PATH": os.pathsep.join([str(settings.installation / ".venv" / "bin"), *SYSTEM]),
        "JUPYTER_CONFIG_PATH": os.pathsep.join(folders),
        "PYTHONHASHSEED": "0",
        "OPENBLAS_NUM_THREADS": "1",
    }
