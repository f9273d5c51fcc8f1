"""Names that the parts of the page of Tazaki's paper share."""

from __future__ import annotations

from typing import Any

from mcplan_bench.speed import PAPER

#: Prefix of the pictures' names: the page is in one folder with those of other papers.
PREFIX = "tazaki_"

#: The published form of the search, and ours.
METHODS: dict[str, dict[str, Any]] = {"paper": PAPER, "standard": {}}
TITLES = {"paper": "paper's form", "standard": "ours"}
