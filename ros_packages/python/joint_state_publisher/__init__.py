"""Publishes positions of the joints that a URDF describes. Names, parameters and messages are upstream's."""
