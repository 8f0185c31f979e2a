"""Records what happens in a run: messages, calls, goals, logs."""
