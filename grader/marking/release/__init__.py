"""Makes exercises/ from solutions/ with nbgrader's own commands, and marks samples to show the whole way."""
