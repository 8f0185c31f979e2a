"""Programs of the course that run beside the student's, one module for each part that they play.

What varies in them is drawn from the seed of the run.
"""
