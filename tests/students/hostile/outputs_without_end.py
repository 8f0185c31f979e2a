"""So many small outputs that the page of feedback would never be done."""

# %% after square
from IPython.display import display

for number in range(990):
    display(number)
