"""Bags to practice with: the fault is drawn, and known."""

from __future__ import annotations

import shutil
from pathlib import Path

from grader.exercises.bags.bag_faults.faulty_bags import BUSY, FAULTS, NONE, draw_case, write_case
from sim.suggestions import closest_match


def faulty_bag(fault: str, seed: int = 0) -> str:
    """Write a bag with a fault into bags/FAULT_SEED, and print the fault's amount; returns the folder.

    Raises ValueError for a fault that there is not.
    """
    known = (*FAULTS, NONE, BUSY)
    if fault not in known:
        near = closest_match(fault, known)
        raise ValueError(
            f"There is no fault {fault!r}: {f'did you mean {near!r}?' if near else ', '.join(known)}"
        )
    case, folder = draw_case(fault, seed), Path("bags", f"{fault}_{seed}")
    shutil.rmtree(folder, ignore_errors=True)
    write_case(case, folder)
    print(f"{folder}: {case.name}" + (f", amount {case.amount:.3f}" if case.amount else ""))
    return str(folder)
