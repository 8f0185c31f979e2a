"""Makes exercises/ from solutions/ with nbgrader's commands; makes the handout; marks samples."""
