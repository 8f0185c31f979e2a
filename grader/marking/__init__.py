"""Marks a class with nbgrader: releases, private seeds, gradebook. The only package that imports nbgrader."""
