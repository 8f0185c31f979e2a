"""Where memory runs out, others shall be killed first."""

# %% after square
import os

with open("/proc/self/oom_score_adj", "w") as file:
    file.write("0")
