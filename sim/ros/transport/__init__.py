"""How messages get from a publisher to its subscriptions: queues, QoS, and the network between hosts."""
