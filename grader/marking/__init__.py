"""Marks a whole class with nbgrader: release, samples, private seeds. The only part that knows nbgrader."""
