"""The process ends in the middle of the notebook."""

# %% after square
import os

os._exit(0)
