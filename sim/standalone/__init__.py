"""The stand-alone robot's picture: a page for browsers on this machine, with a pad to drive."""

from sim.standalone.live_page import LivePage

__all__ = ["LivePage"]
