"""JupyterHub's configuration, as class/hub.toml describes it. Started by `make hub`."""
import os
import sys
from pathlib import Path

from jupyterhub.app import JupyterHub

from grader.marking.extras.hub.course_spawner import CourseSpawner
from grader.marking.extras.hub.hub_settings import read_settings
from grader.marking.extras.hub.server_environment import server_arguments

c = get_config()  # noqa: F821  (JupyterHub provides it)

file = Path(os.environ["ROS2_HUB_SETTINGS"])
settings = read_settings(file)
server = settings.server
CULLER = (sys.executable, "-m", "jupyterhub_idle_culler")
LOCAL = "https://127.0.0.1:"  # what follows is for this machine only
# s; a whole class logs in when a lesson begins: on two cores the last of 40 servers takes some minutes.
PATIENCE = 600

secure = "s" if server.certificate else ""
c.JupyterHub.bind_url = f"http{secure}://{server.address}:{server.port}/"
c.JupyterHub.ssl_cert, c.JupyterHub.ssl_key = server.certificate, server.key
c.ConfigurableHTTPProxy.api_url = f"{LOCAL}{server.port + 1}"
c.JupyterHub.hub_bind_url = f"{LOCAL}{server.port + 2}"
c.JupyterHub.db_url = "sqlite:///jupyterhub.sqlite"
# Servers, proxy and hub know each other by certificates: no other user's program can take a server's place.
c.JupyterHub.internal_ssl = True
# JupyterHub 6.1 hands its services' checks the context of a web server, with which no connection can be made.
_start_service = JupyterHub.start_service
JupyterHub.start_service = lambda self, name, service, _=None: _start_service(self, name, service)
c.JupyterHub.cleanup_servers = True
# Services that end are started again anyway; this check would fail with a traceback while the hub stops.
c.JupyterHub.service_check_interval = 0

# Users and passwords are those of the machine; no other user may log in.
c.JupyterHub.authenticator_class = "pam"
c.PAMAuthenticator.open_sessions = False
c.Authenticator.allowed_users = {*settings.students, *settings.teachers}

CourseSpawner.settings = settings
c.JupyterHub.spawner_class = CourseSpawner
c.Spawner.default_url = "/lab"
c.Spawner.args = server_arguments(server.idle_kernel_minutes)
c.Spawner.http_timeout = c.Spawner.start_timeout = PATIENCE

c.JupyterHub.load_groups = {
    group: {"users": list(names)}
    for course, people in settings.courses.items()
    for group, names in ((f"nbgrader-{course}", people.students), (f"formgrade-{course}", people.teachers))
}
c.JupyterHub.load_roles = [
    {"name": "server", "scopes": ["inherit"]},  # what nbgrader's lists need of the hub
    {
        "name": "idle-culler",
        "scopes": ["list:users", "read:users:activity", "read:servers", "delete:servers"],
        "services": ["idle-culler"],
    },
]
c.JupyterHub.services = [
    {
        "name": "idle-culler",
        "command": [*CULLER, f"--timeout={60 * server.idle_minutes}", "--ssl-enabled=true"],
    }
]
# Each course has a server with its solutions and its gradebook. Its teachers use it, as the user who marks.
for number, course in enumerate(settings.courses):
    c.JupyterHub.load_roles += [
        {
            "name": f"formgrade-{course}",
            "groups": [f"formgrade-{course}"],
            "scopes": [f"access:services!service={course}"],
        },
        {
            "name": f"nbgrader-{course}",
            "groups": [f"nbgrader-{course}", f"formgrade-{course}"],
            "scopes": ["list:services", f"read:services!service={course}"],
        },
    ]
    c.JupyterHub.services.append(
        {
            "name": course,
            "oauth_no_confirm": True,  # it is the course itself that asks
            "timeout": PATIENCE,  # after which the hub would end
            "url": f"{LOCAL}{server.port + 3 + number}",
            "command": [sys.executable, "-m", "grader.marking.extras.hub.course_service", str(file), course],
        }
    )
