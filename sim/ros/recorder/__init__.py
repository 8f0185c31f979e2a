"""Writes down what a run leaves behind: messages, calls, goals, logs; and the file that they are kept in."""
