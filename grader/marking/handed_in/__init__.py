"""Reads what was handed in, and mends it: a notebook that can be run, made from the release."""
