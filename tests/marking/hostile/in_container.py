"""Marks the hostile corpus as a class, and prints what each gets; for a container, where bubblewrap fails.

    python -m tests.marking.hostile.in_container notebooks|packages FOLDER NAME ...
"""
import json
import sys
from pathlib import Path

from tests.marking.hostile import corpus, packages


def main(kind: str, place: str, names: list[str]) -> None:
    """Mark those named in a new folder."""
    folder = Path(place)
    if kind == "packages":
        results = packages.mark(folder, names)
        blocks = {name: packages.reported(result) for name, result in results.items()}
    else:
        corpus.course(folder)
        results = corpus.mark(folder, corpus.submit(folder, names), jobs=1)
        blocks = {name: corpus.block(result) for name, result in results.items()}
    texts = "".join(result.to_json() for result in results.values())
    print(json.dumps({"blocks": blocks, "leaked": corpus.SECRET in texts}))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
