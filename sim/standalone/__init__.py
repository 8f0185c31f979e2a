"""The live page of a stand-alone robot, for browsers on this machine, with a drive pad."""

from sim.standalone.live_page import LivePage

__all__ = ["LivePage"]
