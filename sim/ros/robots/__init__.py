"""The programs of robots and machines: they publish sensors and take commands, as a driver does."""
