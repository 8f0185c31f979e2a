"""`python -m grader mark`: what to mark, what is marked already, and what the instructor hears of it."""
