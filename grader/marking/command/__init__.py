"""`python -m grader mark`: marks the submissions that are not marked yet, and prints a summary."""
