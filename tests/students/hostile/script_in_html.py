"""A script for the instructor's browser."""

# %% after square
from IPython.display import HTML, Javascript, display

display(HTML("<script>steal()</script><img src=x onerror='steal()'>"))
display(Javascript("steal()"))
