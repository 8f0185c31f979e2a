"""The wheel with the module `lidar_rays`."""

from setuptools import setup

setup(py_modules=[], cffi_modules=["rays.py:builder"])
