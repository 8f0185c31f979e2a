"""Launch files in a run: which file is meant, what carries it out, and how its programs become the run's."""
