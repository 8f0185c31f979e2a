"""Launch files in a run: finding a file, executing it, and starting its programs in simulated time."""
