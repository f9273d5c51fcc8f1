"""The papers' tables and figures, a file per paper."""

#: Names that ``mcplan reproduce`` takes.
PAPERS = ("lengagne", "tazaki", "wang")
