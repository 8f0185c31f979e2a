"""Marks on several machines, through Dask."""

from grader.marking.far.far import Far, FarError

__all__ = ["Far", "FarError"]
