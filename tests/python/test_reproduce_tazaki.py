"""mcplan.reproduce.tazaki: the page with its table and figures."""

from __future__ import annotations

import csv
import re

import pytest

from mcplan.cli import main
from mcplan.reproduce import tazaki

pytest.importorskip("matplotlib")


def test_the_page_shows_the_published_times_and_links_what_was_written(tmp_path, capsys):
    assert main(["reproduce", "tazaki", "--quick", "--out", str(tmp_path)]) == 0
    assert str(tmp_path / "tazaki.md") in capsys.readouterr().out
    page = (tmp_path / "tazaki.md").read_text()
    assert "| flat | 12.16 | 11.36 |" in page
    figures = re.findall(r"\]\((.+?\.png)\)", page)
    assert len(figures) == 6  # Figures 1, 3 and 4, both methods
    for name in figures:
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")
    with (tmp_path / "table_2.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert float(row["paper_1_ms"]) > 0.0 and float(row["standard_1_ms"]) > 0.0


def test_the_table_of_the_paper_is_typed_in_right():
    """The paper's own remark: parallel runs took longer on every scene."""
    assert set(tazaki.PUBLISHED_MS) == set(tazaki.SCENES)
    assert all(parallel > alone for parallel, alone in tazaki.PUBLISHED_MS.values())


def test_an_unknown_paper_is_an_error_that_lists_the_known(capsys):
    assert main(["reproduce", "tazki"]) == 2
    assert "must be one of lengagne, tazaki, wang" in capsys.readouterr().err
