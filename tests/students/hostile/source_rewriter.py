"""Every cell's text becomes a number."""

# %% after square
get_ipython().input_transformers_cleanup.append(lambda lines: ["18.0\n"])
