"""Nodes that publish and subscribe."""
