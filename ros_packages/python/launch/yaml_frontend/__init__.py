"""Launch files in YAML, with upstream's keys and with substitutions such as $(var NAME)."""
