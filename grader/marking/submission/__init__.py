"""Reads a submission and repairs it: rebuilds a notebook that can be run from the release and the answers."""
