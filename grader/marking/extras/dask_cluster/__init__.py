"""Marks on several machines, through Dask: python -m grader mark ASSIGNMENT --dask ADDRESS."""

from grader.marking.errors import DaskPoolError
from grader.marking.extras.dask_cluster.dask_pool import DaskPool

__all__ = ["DaskPool", "DaskPoolError"]
