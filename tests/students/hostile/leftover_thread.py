"""A thread goes on after its cell and shows scores."""

# %% after square
import threading


def haunt():
    while True:
        print(18.0)


threading.Thread(target=haunt, daemon=True).start()
