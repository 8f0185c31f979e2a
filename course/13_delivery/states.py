"""The picture of a state machine."""

import math

from IPython.display import Image
from matplotlib.figure import Figure

from sim.view import png


def draw(changes, seen=()):
    """States on a circle, and an arrow for each change (before, after); those seen in a run are thick."""
    names = sorted({name for change in changes for name in change})
    angles = {name: math.tau * number / len(names) for number, name in enumerate(names)}
    places = {name: (math.cos(angle), math.sin(angle)) for name, angle in angles.items()}
    figure = Figure(figsize=(5, 4), layout="constrained")
    axes = figure.add_subplot()
    axes.set(xlim=(-1.5, 1.5), ylim=(-1.4, 1.4), aspect="equal")
    axes.axis("off")
    for before, after in changes:
        found = (before, after) in seen
        look = {"arrowstyle": "-|>", "connectionstyle": "arc3,rad=0.15", "shrinkA": 28, "shrinkB": 28}
        look |= {"color": "tab:blue" if found else "gray", "linewidth": 2.5 if found else 1.0}
        axes.annotate("", xy=places[after], xytext=places[before], arrowprops=look)
    for name, place in places.items():
        box = {"boxstyle": "round,pad=0.5", "facecolor": "white", "edgecolor": "black"}
        axes.text(*place, name, ha="center", va="center", bbox=box)
    words = ", ".join(f"{before} to {after}" for before, after in sorted(changes))
    return Image(png(figure), alt=f"States, and changes between them: {words}")
