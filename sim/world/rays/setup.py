"""The wheel with the module `lidar_rays`, for every Python from 3.11 on."""

from setuptools import setup

setup(
    py_modules=[],
    cffi_modules=["rays.py:builder"],
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
