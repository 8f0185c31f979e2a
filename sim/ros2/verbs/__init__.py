"""All groups of verbs. One module has each; `sim.ros2.words` puts them together."""
