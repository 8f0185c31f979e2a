"""All names are deleted before the test."""

# %% after square
get_ipython().run_line_magic("reset", "-f")
