"""A package, so that its tests share a browser from the first to the last."""
