"""Signed JSON: a DSSE envelope of securesystemslib with an in-toto statement, and the instructor's keys."""
import json
from pathlib import Path
from typing import Any

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError, NotConfirmed

KIND = "application/vnd.in-toto+json"
PRIVATE = ".signing-key"  # beside .secret; git ignores both
PUBLIC = "public.pem"
ENVELOPE_FIELDS = {"payload", "payloadType", "signatures"}


def make_keys(private: Path, public: Path) -> Any:
    """The instructor's signer; makes a key if there is none, and writes the public one.

    Raises CourseError, OSError.
    """
    from cryptography.hazmat.primitives import serialization
    from securesystemslib.signer import CryptoSigner

    if not private.exists():
        write_atomically(private, CryptoSigner.generate_ed25519().private_bytes, 0o600)
    if private.stat().st_mode & 0o077:
        raise CourseError(f"others may read {private}: run `chmod 600 {private.name}`")
    try:
        key = serialization.load_pem_private_key(private.read_bytes(), None)
        signer = CryptoSigner(key)
    except (OSError, ValueError, TypeError) as error:
        raise CourseError(f"{private} is not a private key ({error}): take it from a backup") from None
    form = serialization.Encoding.PEM, serialization.PublicFormat.SubjectPublicKeyInfo
    write_atomically(public, key.public_key().public_bytes(*form))
    return signer


def read_key(path: Path) -> Any:
    """A public key. Raises NotConfirmed."""
    from cryptography.hazmat.primitives import serialization
    from securesystemslib.signer import SSlibKey

    try:
        return SSlibKey.from_crypto(serialization.load_pem_public_key(path.read_bytes()))
    except OSError as error:
        raise NotConfirmed(f"expected the instructor's public key, saw {path} ({error.strerror})") from None
    except ValueError:
        raise NotConfirmed(f"expected the instructor's public key, saw {path}, which is not one") from None


def sign(statement: dict[str, Any], signer: Any) -> str:
    """The signed statement, as JSON."""
    from securesystemslib.dsse import Envelope

    envelope = Envelope(json.dumps(statement, sort_keys=True, ensure_ascii=False).encode(), KIND, {})
    envelope.sign(signer)
    return json.dumps(envelope.to_dict(), indent=1) + "\n"


def open_signed(text: str, key: Any) -> Any:
    """Return what was signed with this key. Raises NotConfirmed."""
    from securesystemslib.dsse import Envelope
    from securesystemslib.exceptions import FormatError, VerificationError

    try:
        data = json.loads(text)
        if not isinstance(data, dict) or set(data) != ENVELOPE_FIELDS:
            raise ValueError("it has other fields than payload, payloadType and signatures")
        envelope = Envelope.from_dict(data)
    except (ValueError, KeyError, TypeError, AttributeError, FormatError, RecursionError) as error:
        raise NotConfirmed(f"this is not a receipt, or it is damaged ({error})") from None
    if not envelope.signatures:
        raise NotConfirmed("this receipt is not signed")
    if key.keyid not in envelope.signatures:
        raise NotConfirmed("this receipt was signed with a different key from the one given")
    try:
        envelope.verify([key], 1)
    except VerificationError:
        why = "the receipt was changed after it was issued"
        raise NotConfirmed(f"the signature does not match: {why}") from None
    if envelope.payload_type != KIND:
        raise NotConfirmed(f"what was signed is not an in-toto statement but {envelope.payload_type!r}")
    return json.loads(envelope.payload)
