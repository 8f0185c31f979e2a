"""How messages get from one end to another: queues, quality of service, and the network in between."""
