"""Nodes with parameters."""
