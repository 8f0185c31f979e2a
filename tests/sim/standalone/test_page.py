"""The stand-alone robot's page: who may see it, who may drive, and what a browser makes of it."""

import base64
import contextlib
import http.client
import json
import os
import re
import socket
import struct

import pytest
from playwright.sync_api import expect

from sim.standalone import live_page, server
from tests.browser.lab import ARTIFACTS
from tests.browser.pictures import COLORS, chromium, patient_page
from tests.patience import PATIENCE
from tests.sim.standalone.programs import ended, robot

GRAPH = {"words": "absent"}
FACTS = {"world": {"name": "nowhere"}, "status": {}}
DRIVE = json.dumps({"drive": [1, -0.5]})
FORBIDDEN = (403, b"Forbidden\n")
BAD = (400, b"Bad Request\n")


@pytest.fixture(scope="module")
def browser():
    with chromium() as started:
        yield started


@pytest.fixture
def page():
    driven = []
    made = server.PageServer(0, FACTS, driven.append, lambda: GRAPH)
    with contextlib.closing(made) as running:
        running.driven = driven
        yield running


def request(page, method, path, body=None, **headers):
    """Status and body of one request; underscores in names of headers are dashes."""
    connection = http.client.HTTPConnection("127.0.0.1", page.port, timeout=PATIENCE)
    names = {name.replace("_", "-"): value for name, value in headers.items()}
    connection.request(method, path, body, {"Host": f"localhost:{page.port}"} | names)
    answer = connection.getresponse()
    return answer.status, answer.read()


@pytest.mark.parametrize(("user", "served"), [(0, True), (os.geteuid(), True), (None, True), (4242, False)])
def test_a_page_is_for_the_programs_of_its_own_user(page, monkeypatch, user, served):
    monkeypatch.setattr(server, "user_of_connection", lambda client, address: user)
    if served:
        assert request(page, "GET", "/")[0] == 200
    else:
        with pytest.raises((http.client.RemoteDisconnected, ConnectionResetError)):
            request(page, "GET", "/")


def test_linux_says_whose_program_has_connected(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as listener:
        with socket.create_connection(listener.getsockname()) as client:
            ends = client.getsockname(), listener.getsockname()
            assert server.user_of_connection(*ends) == os.geteuid()
            assert server.user_of_connection(*ends, table=tmp_path / "missing") is None
        assert server.user_of_connection(("127.0.0.1", 1), listener.getsockname()) is None


def own(page):
    return f"http://localhost:{page.port}"


def test_the_page_has_all_its_parts(page):
    status, html = request(page, "GET", "/")
    assert status == 200
    assert re.findall(rb'src="(.*?)"', html) == [b"/page.js"]
    assert b'from "/live.js"' in request(page, "GET", "/page.js")[1]
    assert b"export default" in request(page, "GET", "/live.js")[1]
    assert json.loads(request(page, "GET", "/world")[1]) == FACTS
    assert json.loads(request(page, "GET", "/graph")[1]) == GRAPH
    assert request(page, "GET", "/../server.py") == (404, b"Not Found\n")


def test_only_its_own_page_drives(page):
    assert request(page, "POST", "/command", DRIVE, Origin=own(page)) == (200, b"")
    assert page.driven == [{"drive": [1.0, -0.5]}]
    for headers in (
        {},
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://evil.example", "Host": "evil.example"},  # a name that leads here
        {"Origin": f"http://localhost:{page.port + 1}"},
    ):
        assert request(page, "POST", "/command", DRIVE, **headers) == FORBIDDEN
    assert page.driven == [{"drive": [1.0, -0.5]}]


@pytest.mark.parametrize("body", [
    "", "{", "[" * 199, '{"drive": [1]}', '{"drive": [1, NaN]}', '{"drive": [2, 0]}', '{"stop": true}',
    '{"drive": [true, 0]}', '{"drive": [1, 0]}' + " " * 2000,
    '{"shown": ["/tf", 3]}', '{"shown": ["/tf"' + ', ""' * 20 + "]}",
])  # fmt: skip
def test_what_is_no_command_is_refused(page, body):
    assert request(page, "POST", "/command", body, Origin=own(page)) == BAD
    assert page.driven == []


def test_other_sites_see_nothing(page):
    for path in ("/", "/world", "/frames"):
        assert request(page, "GET", path, Host="evil.example") == FORBIDDEN
    for path in ("/world", "/frames", "/live.js", "/graph"):
        assert request(page, "GET", path, Sec_Fetch_Site="cross-site") == FORBIDDEN


def stream(page):
    connection = http.client.HTTPConnection("127.0.0.1", page.port, timeout=PATIENCE)
    connection.request("GET", "/frames", headers={"Host": f"localhost:{page.port}"})
    return connection.getresponse()


def test_frames_come_as_they_are_shown_and_end_with_the_robot(page):
    page.show(b"\x00\x01\x02", [{"topic": "/tf"}])
    frames = stream(page)
    assert frames.readline() == b'data: ["AAEC", [{"topic": "/tf"}]]\n'
    page.close()
    assert frames.read() == b"\n"


def test_a_changed_status_is_sent_with_the_next_frame_and_to_later_pages(page):
    for _ in range(2):
        page.send_status({"drawn": 3})
        with contextlib.closing(stream(page)) as frames:
            page.show(b"")
            lines = [frames.readline() for _ in range(4)]
        assert lines == [b"event: status\n", b'data: {"drawn": 3}\n', b"\n", b'data: ["", []]\n']


def test_so_many_may_look_and_no_more(page):
    page.show(b"frame")
    streams = [stream(page) for _ in range(server.MAX_VIEWERS)]
    assert {one.status for one in streams} == {200}
    assert stream(page).status == 503


def test_a_port_in_use_is_reported_in_a_sentence():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        sentence = f"Port {port} can't be used (Address already in use); choose another with --port.\n"
        assert ended("--port", str(port)) == (2, "", sentence)


def test_of_some_ports_the_first_that_is_free_is_taken():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        ports = [taken.getsockname()[1], 0]
        with contextlib.closing(live_page.open_server(ports, FACTS, print, lambda: GRAPH)) as page:
            assert json.loads(request(page, "GET", "/graph")[1]) == GRAPH
        with pytest.raises(OSError, match="Address already in use"):
            live_page.open_server(ports[:1], FACTS, print, lambda: GRAPH)


@pytest.mark.browser
def test_a_browser_shows_the_robot_and_drives_it(browser):
    with robot("--world", "yard", "--port", "0") as running:
        address = re.search(r"See and drive it at (\S+)", running.offer)[1]
        page = patient_page(browser)
        faults = []
        page.on("console", lambda line: faults.append(line.text))
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(address)
        expect(page.locator(".time b")).to_have_text(re.compile(r"^(0\.[5-9]|[1-9])"))
        page.get_by_role("application").click()
        page.keyboard.down("ArrowUp")
        running.receive_until(lambda received: received["x"] > 0.2 and received["v"] > 0.0)
        page.keyboard.up("ArrowUp")
        running.receive_until(lambda received: received["v"] == 0.0)
        page.locator(".graph summary").press("Enter")
        page.locator(".graph svg .course text", has_text="/robot").wait_for()
        page.locator(".graph svg .course text", has_text="/teleop").wait_for()
        with running.beside("crowd"):
            page.locator(".graph svg .node text").first.wait_for()
        page.screenshot(path=ARTIFACTS / "standalone-graph.png", full_page=True)
        assert faults == []
        assert running.stop() == (0, "")
        page.get_by_text("The robot's program has ended.").wait_for()
        page.close()


@pytest.mark.browser
def test_the_page_has_the_panel_of_the_notebook_and_connects_again_by_itself(browser):
    with robot("--world", "room", "--port", "0") as running:
        address = re.search(r"See and drive it at (\S+)", running.offer)[1]
        page = patient_page(browser)
        faults = []
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(address)
        assert page.locator(".legend").inner_text().split()[:5] == ["room", "★", "goal", "■", "obstacle"]
        number = page.locator(".numbers div", has_text="nearest")
        expect(number.locator("dd")).to_have_text(re.compile(r"\d\.\d\d m"))
        expect(page.locator(".topic", has_text="/scan")).to_contain_text("Hz")
        page.locator("button.topic", has_text="/odom").click()
        expect(page.locator(".looked pre")).to_contain_text("child_frame_id: base_link")
        expect(page.locator(".looked")).to_contain_text("nav_msgs/msg/Odometry")
        page.screenshot(path=ARTIFACTS / "standalone-panel.png", full_page=True)
        page.locator(".legend button.layer", has_text="/tf").click()  # its frames have red and green axes
        has_red = f"({COLORS})(document.querySelector('.stage canvas')).includes('c92a2a')"
        page.wait_for_function(f"() => {has_red}")
        page.screenshot(path=ARTIFACTS / "standalone-layers.png", full_page=True)
        page.locator(".legend button.layer", has_text="/tf").click()
        page.wait_for_function(f"() => !{has_red}")
        port = address.rpartition(":")[2]
        assert running.stop() == (0, "")
        text = "The robot's program has ended. When it is started again, this page connects to it by itself."
        page.get_by_text(text).wait_for()
    with robot("--world", "yard", "--port", port):
        page.locator(".legend", has_text="yard").wait_for()
        assert faults == []
        page.close()


@pytest.mark.browser
def test_a_second_robot_is_reported_once_in_the_terminal_and_on_the_page(browser):
    with robot("--world", "yard", "--port", "0") as running:
        page = patient_page(browser)
        page.goto(re.search(r"http://\S+", running.offer)[0])
        domain = running.domain
        text = (
            f"There is a second /robot on ROS domain {domain} of this machine: both obey the same commands,"
            f" and their messages mix. End one of them, or start one with --domain {domain + 1}."
        )
        with running.beside("second_robot"):
            page.get_by_text(text).wait_for()
        assert running.stop() == (0, f"{text}\n")
        page.close()


@pytest.mark.browser
def test_a_machine_is_shown_without_a_pad(browser):
    with robot("--world", "arm", "--port", "0") as running:
        page = patient_page(browser)
        page.goto(re.search(r"at (http://\S+)", running.offer)[1])
        expect(page.locator(".time b")).to_have_text(re.compile(r"^(0\.[1-9]|[1-9])"))
        assert page.get_by_text("/joint_commands").count() == 1
        assert page.get_by_text("DRIVE").count() == page.get_by_text("drive with the arrow keys").count() == 0
        page.close()


@pytest.mark.browser
def test_turtles_and_their_lines_are_shown(browser):
    with robot("--world", "turtlesim", "--port", "0") as running:
        tab = patient_page(browser)
        tab.faults = []
        tab.on("pageerror", lambda error: tab.faults.append(str(error)))
        tab.goto(re.search(r"http://\S+", running.offer)[0])
        tab.get_by_role("application").focus()
        tab.keyboard.down("ArrowUp")
        tab.wait_for_function(f"() => ({COLORS})(document.querySelector('canvas')).includes('b3b8ff')")
        tab.keyboard.up("ArrowUp")
        names = [row.locator("span").first.inner_text() for row in tab.locator(".topic").all()]
        assert names == ["/turtle1/cmd_vel", "/turtle1/color_sensor", "/turtle1/pose"]
        assert tab.faults == []
        tab.close()


def test_a_frame_holds_stamp_poses_and_scan():
    with robot("--world", "room", "--port", "0") as running:
        port = int(re.search(r"localhost:(\d+)", running.offer)[1])
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
        connection.request("GET", "/frames")
        lines = iter(connection.getresponse().readline, b"")
        line = next(line for line in lines if line.startswith(b"data: ") and b"{" not in line)
        frame, layers = json.loads(line.removeprefix(b"data: "))
        raw = base64.b64decode(frame)
        assert layers == []
        floats = struct.unpack(f"<{len(raw) // 4}f", raw)
        assert len(floats) == 1 + 3 + 3 + 360
        assert floats[1:7] == (0.0,) * 6
        assert floats[7] == pytest.approx(3, abs=0.06)  # the wall ahead
        assert running.stop() == (0, "")
