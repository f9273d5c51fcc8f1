"""The version stands in one place, and what describes the release agrees with it."""

import importlib.metadata
import re
from pathlib import Path

import pytest

import mcplan

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(
    r'#define MCPLAN_VERSION "(.+)"', (ROOT / "cpp/include/mcplan/version.hpp").read_text(encoding="utf-8")
).group(1)  # the CMake package is compared with it in tests/consumer


def test_module_has_the_version_of_the_header():
    assert mcplan.__version__ == VERSION


@pytest.mark.parametrize("name", ["mcplan", "mcplan-bench"])
def test_installed_distributions_have_the_version_of_the_header(name):
    try:
        version = importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        pytest.skip(f"{name} is imported from the source tree, not installed")
    assert version == VERSION


def test_changelog_has_a_heading_for_the_version():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(rf"^## \[{re.escape(VERSION)}\] - \d{{4}}-\d\d-\d\d$", text, re.MULTILINE)


def test_citation_does_not_repeat_the_version():
    assert not re.search(r"^version:", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)


def test_every_dependency_is_noted_with_its_licence():
    notes = (ROOT / "third_party_notes.md").read_text(encoding="utf-8").lower()
    both = "".join((ROOT / file).read_text(encoding="utf-8") for file in ("pyproject.toml", "bench/pyproject.toml"))
    lists = re.findall(r"^\w+ = \[(.*?)\]$", both, re.M | re.S)
    names = {match for text in lists for match in re.findall(r'"([\w-]+)[><=~]+[\d.]+', text)}
    assert {"numpy", "meshcat", "pytest"} <= names
    aliases = {"example-robot-data-loaders": "example-robot-data"}
    assert [name for name in sorted(names) if aliases.get(name, name).lower() not in notes] == []


def test_links_of_the_markdown_files_lead_somewhere():
    pages = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    pages.remove(ROOT / "docs/site/index.md")  # leads to pages that are made with the site, which checks its own links
    broken = [
        f"{page.relative_to(ROOT)}: {target}"
        for page in pages
        for target in re.findall(r"\]\(([^)#\s]+)", page.read_text(encoding="utf-8"))
        if "://" not in target and not (page.parent / target).exists()
    ]
    assert broken == []
