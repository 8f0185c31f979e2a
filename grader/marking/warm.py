"""All that a judge or a student's process imports. Processes that fork them import it once, beforehand."""

import sys

# jsonschema checks a kind of address with it that no notebook has; to import it takes longer than the rest.
sys.modules.setdefault("rfc3987_syntax", None)  # type: ignore[assignment]

import IPython.core.interactiveshell  # noqa: E402, F401
import matplotlib.pyplot  # noqa: E402, F401
import matplotlib_inline.backend_inline  # noqa: E402, F401
import nbformat  # noqa: E402, F401

import sim.view  # noqa: E402, F401
from grader.catalogue import exercises  # noqa: E402

exercises()
