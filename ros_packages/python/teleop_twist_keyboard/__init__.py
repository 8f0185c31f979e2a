"""The package teleop_twist_keyboard: keys drive a robot. Its program is the module of that name."""
