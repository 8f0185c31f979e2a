"""How `rays.c` becomes the module `lidar_rays`: cffi writes the part that Python calls."""

import re
from pathlib import Path

from cffi import FFI

SOURCE = Path(__file__).with_name("rays.c").read_text(encoding="utf-8")

builder = FFI()
# What Python may call is what is not static.
builder.cdef("".join(f"{head};" for head in re.findall(r"^void [^{]+", SOURCE, re.MULTILINE)))
# Fused multiplications would round otherwise than Python does, and only on some processors. Debugging
# information includes the folder of the build, so two builds would differ.
OPTIONS = ["-O2", "-ffp-contract=off", "-g0"]
builder.set_source("lidar_rays", SOURCE, extra_compile_args=OPTIONS, libraries=["m"])
