"""Marks on several machines, through Dask."""

from grader.marking.errors import DaskPoolError
from grader.marking.machines.dask_pool import DaskPool

__all__ = ["DaskPool", "DaskPoolError"]
