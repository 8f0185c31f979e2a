"""A package, so that its tests share a cluster from the first to the last."""
