"""Someone outside is asked for help."""

# %% after square
import socket

for address in [("127.0.0.1", 22), ("1.1.1.1", 53)]:
    try:
        socket.create_connection(address, timeout=2)
        print("connected")
    except OSError as error:
        print(type(error).__name__)
