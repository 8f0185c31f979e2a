"""Publishes the frames of a robot that a URDF describes. Names, parameters and messages are upstream's."""
