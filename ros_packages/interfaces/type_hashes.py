"""Print the type hash of every interface and whether it is upstream's.

    python ros_packages/interfaces/type_hashes.py

Equal hashes mean equal names and fields, down to the last nested message (REP-2011).
"""

import json
import sys
import tomllib

from build_tools.content import ROOT
from build_tools.toolchain import ros_prefix


def installed() -> dict[str, str]:
    """Return {type name: hash} for every interface in definitions/, and for its parts."""
    hashes = {}
    for package in sorted(path.name for path in (ROOT / "definitions").iterdir()):
        for file in sorted(ros_prefix().glob(f"share/{package}/*/*.json")):
            described = json.loads(file.read_text(encoding="utf-8"))["type_hashes"]
            own = (entry for entry in described if entry["type_name"].startswith(f"{package}/"))
            hashes |= {entry["type_name"]: entry["hash_string"] for entry in own}
    return hashes


def upstream() -> dict[str, str]:
    """Return {type name: hash} for the interfaces whose upstream hash is recorded."""
    return tomllib.loads((ROOT / "upstream_hashes.toml").read_text(encoding="utf-8"))


def compare(found: str, expected: str | None) -> str:
    """Return how a hash compares with upstream's (None: not recorded)."""
    if expected is None:
        return "no upstream hash recorded"
    return "as upstream" if found == expected else f"upstream has {expected}"


def main() -> int:
    """Print one line per interface and per recorded part; return 1 if one differs from upstream's."""
    found, expected = installed(), upstream()
    for name, type_hash in sorted(found.items()):
        # The hash of a service or action covers its parts, such as Spin_Goal.
        if "_" not in name.split("/")[2] or name in expected:
            print(f"{name}  {type_hash}  {compare(type_hash, expected.get(name))}")
    return int(not expected.items() <= found.items())


if __name__ == "__main__":
    sys.exit(main())
