"""The picture of a robot: live in JupyterLab in Chromium, and as a replay."""

import asyncio
import shutil
import tempfile
import time
from pathlib import Path

from tests.bench.report import avoider_run, table

ROOT = Path(__file__).parents[2]
RATE, SECONDS = 30, 10  # frames a second, and for how long
CELLS = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
from sim import World, play
from sim.view.live_view import LiveView
from tests.bench import avoider
from tests.bench.view import Bare, cpu, feed

idle = await feed(None)
===
view = LiveView(World.load("room"))
view.show()
===
fed = await feed(view)
===
bare = await feed(Bare(view))
view.close()
===
player = play(avoider.main, world="room", seconds=600)
===
import asyncio
begin = cpu(), player.recording.stamp
await asyncio.sleep({SECONDS})
played = cpu() - begin[0]
pace = (player.recording.stamp - begin[1]) / {SECONDS}
player.stop()
"""


def cpu() -> float:
    """What this process has computed so far, all its threads together, in s."""
    return time.process_time()


def frames() -> list[tuple]:
    """Frames of a drive with 360 rays: stamp, poses and scan."""
    from sim.world import World, simulate

    scene = simulate(World.load("room"), 0)
    scene.robot.command(0.4, 0.5)
    found = []
    for index in range(RATE * SECONDS):
        scene.advance(index / RATE)
        if index % 3 != 1:  # 20 Hz
            scene.robot.scan()
        found.append((index / RATE, scene.poses, scene.last_scan))
    return found


class Bare:
    """Sends what a frame is as Jupyter sends anything: it was made before, and no widget is asked."""

    def __init__(self, view) -> None:
        from sim.view.live_view import pack_frame

        self._comm, self._frame = view.comm, pack_frame(*frames()[0])

    def frame(self, *_: object) -> None:
        self._comm.send({"method": "custom", "content": {}}, buffers=[self._frame])


async def feed(view) -> float:
    """Show all frames at their pace, or none of them; what the kernel computed meanwhile, in s."""
    prepared = frames()
    computed, begin = cpu(), time.monotonic()
    for stamp, poses, scan in prepared:
        await asyncio.sleep(max(begin + stamp - time.monotonic(), 0))
        if view is not None:
            view.frame(stamp, poses, scan)
    await asyncio.sleep(0.5)  # what still waits is sent
    return cpu() - computed


def in_lab() -> tuple[list[int], list[float]]:
    """Frames painted while each cell ran, and what the cells measured: idle, fed, bare, played, pace."""
    from playwright.sync_api import sync_playwright

    from tests.browser.lab import Lab, server, write_notebook
    from tests.browser.pictures import COUNT_FRAMES

    cells = CELLS.split("===\n")
    folder = Path(tempfile.mkdtemp(prefix="bench-view-"))
    write_notebook(folder / "view.ipynb", *cells)
    with server(folder, "--allow-root") as address, sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = chromium.new_page(viewport={"width": 1280, "height": 900})
        page.add_init_script(COUNT_FRAMES)
        lab = Lab(page, address)
        lab.open("view.ipynb")
        painted = []
        for index in range(len(cells)):
            before = page.evaluate("window.framesPainted")
            lab.run_cell(index)
            painted.append(page.evaluate("window.framesPainted") - before)
            page.wait_for_timeout(500)
        measured = lab.ask("[idle, fed, bare, played, pace]")
        lab.shut_down()
        chromium.close()
    shutil.rmtree(folder, ignore_errors=True)
    return painted, measured


def live() -> list[list[object]]:
    """Of the picture in a real kernel and a real browser."""
    painted, (idle, fed, bare, played, pace) = in_lab()

    def frame(computed: float) -> str:
        return f"{(computed - idle) / (RATE * SECONDS) * 1e3:.2f} ms"

    return [
        ["frames sent / shown in a second", f"{RATE} / {painted[2] / SECONDS:.1f}"],
        ["kernel, computing for a frame with 360 rays", frame(fed)],
        ["of that Jupyter's own, for any message of that size", frame(bare)],
        ["play(): frames shown in a second", f"{painted[5] / SECONDS:.1f}"],
        ["play() at 1 x, robot, student's node and picture: of one core", f"{played / SECONDS:.0%}"],
        ["play() at 1 x: measured pace", f"{pace:.3f} x"],
    ]


def kept() -> list[list[object]]:
    """Of a replay, against the picture that matplotlib alone makes."""
    from sim.view import plot_path, png
    from sim.view.replay import PLAYER_SCRIPT, replay

    recording = avoider_run(world="room", seconds=20)

    def seconds(make) -> float:
        make()
        begin = time.perf_counter()
        make()
        return time.perf_counter() - begin

    page = replay(recording).html
    whole = seconds(lambda: replay(recording))
    figure = seconds(lambda: png(plot_path(recording)))
    return [
        ["replay of 20 s with lidar, all included", f"{len(page) / 1024:.0f} KiB"],
        ["of that the player, always the same", f"{len(PLAYER_SCRIPT) / 1024:.0f} KiB"],
        ["to make it", f"{whole * 1e3:.0f} ms"],
        ["of that matplotlib's figure, or one frame by matplotlib", f"{figure * 1e3:.0f} ms"],
    ]


def main() -> None:
    """Measure both."""
    table(["", ""], kept())
    if not shutil.which("chromium"):
        print("no Chromium here, so the live picture is not measured: `apt install chromium`")
        return
    table(["", ""], live())


if __name__ == "__main__":
    main()
