"""Receipts: marks that the instructor has signed, which anyone with the public key can confirm."""
