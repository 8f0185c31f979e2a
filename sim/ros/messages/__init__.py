"""Messages as bytes: encoding, decoding and the canonical form."""
