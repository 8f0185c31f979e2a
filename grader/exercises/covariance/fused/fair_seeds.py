"""Seeds with which an honest filter is neither much better nor much worse than with the others."""

FAIR = (
    3, 4, 6, 10, 11, 25, 27, 29, 31, 32, 41, 43, 47, 48, 49, 51, 52, 62, 67, 82, 86, 88, 90, 92, 94, 96,
    99, 102, 104, 105, 110, 113, 117, 118,
)
