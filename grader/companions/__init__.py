"""Programs of the course that run beside the student's, one module for each part that they play."""
