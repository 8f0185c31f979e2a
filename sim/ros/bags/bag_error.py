"""The error of a bag that can't be used."""


class BagError(Exception):
    """A bag that can't be read, played or written: one sentence for the user."""
