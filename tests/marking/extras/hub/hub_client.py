"""A user of a hub as a browser acts: logs in, starts the server, edits files, runs cells, hands in."""
import json
import time
import uuid
from typing import Any
from urllib.parse import quote, urlencode

import requests
import websocket

from tests.patience import PATIENCE


class HubClient:
    """One user's session with a hub at an address such as http://127.0.0.1:8000."""

    def __init__(self, address: str, user: str, password: str) -> None:
        self.address, self.user = address, user
        self.session = requests.Session()
        form = {"username": user, "password": password}
        self.session.get(f"{address}/hub/login", timeout=PATIENCE)
        form["_xsrf"] = self._cookie("_xsrf", "/hub/")
        self.login = self.session.post(f"{address}/hub/login", data=form, timeout=PATIENCE)
        self.base = f"{address}/user/{user}"

    @property
    def logged_in(self) -> bool:
        """Whether the hub accepted name and password."""
        return self._cookie("jupyterhub-hub-login", "/hub/") is not None

    def start_server(self) -> None:
        """Start the user's server and wait until it answers."""
        assert self.logged_in, f"the hub does not let {self.user} in: {self.login.status_code}"
        self.session.get(f"{self.address}/hub/spawn/{self.user}", timeout=PATIENCE)
        end = time.monotonic() + PATIENCE
        while True:
            page = self.get("lab")  # which logs in with the hub, once the server is there
            if page.ok and page.url.startswith(f"{self.base}/lab"):
                return
            assert time.monotonic() < end, f"the server of {self.user} has not started: {page.url}"
            time.sleep(2)  # the page that waits asks less often

    def get(self, path: str) -> requests.Response:
        """What the user's server answers; by way of the hub's login where that is needed."""
        return self.session.get(f"{self.base}/{path}", timeout=PATIENCE)

    def send(self, method: str, path: str, data: Any = None, form: dict[str, str] | None = None) -> requests.Response:
        """Change something on the user's server."""
        headers = {"X-XSRFToken": self._cookie("_xsrf", f"/user/{self.user}/") or ""}
        where = f"{self.base}/{path}"
        return self.session.request(method, where, json=data, data=form, headers=headers, timeout=PATIENCE)

    def read_notebook(self, path: str) -> dict[str, Any]:
        """The content of a notebook in the user's folder."""
        answer = self.get(f"api/contents/{quote(path)}?content=1")
        answer.raise_for_status()
        return answer.json()["content"]

    def save_notebook(self, path: str, content: dict[str, Any]) -> None:
        """Save a notebook."""
        data = {"type": "notebook", "format": "json", "content": content}
        self.send("PUT", f"api/contents/{quote(path)}", data).raise_for_status()

    def start_kernel(self, path: str) -> "KernelClient":
        """Start a kernel for a notebook, in its folder."""
        data = {"path": path, "name": path, "type": "notebook", "kernel": {"name": "python3"}}
        answer = self.send("POST", "api/sessions", data)
        answer.raise_for_status()
        return KernelClient(self, answer.json()["kernel"]["id"])

    def submit(self, course: str, assignment: str) -> dict[str, Any]:
        """Hand in, with the button of nbgrader's list of assignments."""
        form = {"course_id": course, "assignment_id": assignment}
        return self.send("POST", "assignments/submit", form=form).json()

    def fetch_feedback(self, course: str, assignment: str) -> dict[str, Any]:
        """Fetch feedback, with the button there."""
        form = {"course_id": course, "assignment_id": assignment}
        return self.send("POST", "assignments/fetch_feedback", form=form).json()

    def cookies(self, path: str) -> str:
        """The cookies for an address of the hub, as a header."""
        request = requests.Request("GET", f"{self.address}{path}")
        return self.session.prepare_request(request).headers.get("Cookie", "")

    def _cookie(self, name: str, path: str) -> str | None:
        return next((each.value for each in self.session.cookies if (each.name, each.path) == (name, path)), None)


class KernelClient:
    """A kernel on a user's server, through the server's WebSocket."""

    def __init__(self, client: HubClient, kernel: str) -> None:
        self.client, self.kernel = client, kernel
        path = f"/user/{client.user}/api/kernels/{kernel}/channels"
        address = client.address.replace("http", "ws", 1) + path + "?" + urlencode({"session_id": uuid.uuid4().hex})
        self.socket = websocket.create_connection(
            address, cookie=client.cookies(path), origin=client.address, timeout=PATIENCE
        )

    def begin(self, source: str) -> str:
        """Begin to run a cell; returns the request's id."""
        request = uuid.uuid4().hex
        header = {"msg_id": request, "msg_type": "execute_request", "username": "", "session": "", "version": "5.3"}
        header["date"] = "2026-01-01T00:00:00Z"
        content = {"code": source, "silent": False, "store_history": True, "stop_on_error": True}
        message = {"header": header, "parent_header": {}, "metadata": {}, "content": content}
        self.socket.send(json.dumps(message | {"channel": "shell", "buffers": []}))
        return request

    def run(self, source: str) -> dict[str, Any]:
        """Run a cell; returns its status, its text and its seconds."""
        begin, request = time.monotonic(), self.begin(source)
        status, texts, comms, idle = "", [], 0, False
        while not (status and idle):
            received = self.socket.recv()
            if isinstance(received, bytes):  # with buffers, as live pictures have them
                comms += 1
                continue
            reply = json.loads(received)
            if reply["content"].get("execution_state") in ("restarting", "dead"):
                return {"status": "dead", "text": "".join(texts), "seconds": time.monotonic() - begin}
            if reply["parent_header"].get("msg_id") != request:
                comms += reply["msg_type"].startswith("comm")
                continue
            kind, body = reply["msg_type"], reply["content"]
            if kind == "execute_reply":
                status = body["status"]
            elif kind == "stream":
                texts.append(body["text"])
            elif kind in ("execute_result", "display_data"):
                texts.append(body["data"].get("text/plain", ""))
            elif kind == "error":
                texts.append("\n".join(body["traceback"]))
            elif kind == "status":
                idle = body["execution_state"] == "idle"
            comms += kind.startswith("comm")
        seconds = time.monotonic() - begin
        return {"status": status, "text": "".join(texts), "seconds": seconds, "comms": comms}

    def stop(self) -> None:
        """Shut the kernel down."""
        self.socket.close()
        self.client.send("DELETE", f"api/kernels/{self.kernel}")
