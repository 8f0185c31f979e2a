"""The README's moving picture, of the benchmarks' scenario.

python -m tests.bench.picture
"""

from pathlib import Path

from sim.view import animate
from tests.bench.report import avoider_run

PICTURE = Path("course/images/run.png")


if __name__ == "__main__":
    PICTURE.write_bytes(bytes(animate(avoider_run(world="room", seconds=60), speed=3)))
    print(f"{PICTURE}: {PICTURE.stat().st_size / 1000:.0f} kB")
