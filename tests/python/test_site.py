"""The site: links are those of the repository, docstrings are read as they are meant, and it builds without a warning."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

pytest.importorskip("mcplan.tracking.options")
from pages import commands  # noqa: E402
from pages.site import docstrings, gallery, local_links, stage  # noqa: E402


def staged(folder: Path, text: str, name: str = "docs/a.md", written_at: str = "docs/a.md") -> str:
    stage.write_page(folder, name, text, written_at)
    return (folder / name).read_text(encoding="utf-8").strip()


@pytest.mark.parametrize(
    ("link", "moved"),
    [
        ("ddp.md#options", "ddp.md#options"),
        ("../README.md", "../README.md"),
        ("../examples", "../reference/examples.md"),
        ("index.md", "../index.md"),
        ("https://example.org/a.md", "https://example.org/a.md"),
        ("#here", "#here"),
    ],
)
def test_links_lead_to_what_they_led_to(tmp_path, link, moved):
    assert staged(tmp_path, f"See [this]({link}).") == f"See [this]({moved})."


def test_a_page_may_move(tmp_path):
    text = staged(tmp_path, "[a](../ddp.md) [b](gallery.md)", "index.md", "docs/site/index.md")
    assert text == "[a](docs/ddp.md) [b](gallery.md)"


def test_files_that_are_linked_to_come_along(tmp_path):
    assert staged(tmp_path, "[a](../examples/sweep.toml)") == "[a](../examples/sweep.toml)"
    assert (tmp_path / "examples/sweep.toml").read_bytes() == (ROOT / "examples/sweep.toml").read_bytes()


def test_code_is_left_alone(tmp_path):
    assert staged(tmp_path, "```\nf[i](../examples)\n```") == "```\nf[i](../examples)\n```"


def as_read(text: str, what: str = "function", name: str = "f") -> list[str]:
    lines = text.splitlines()
    docstrings.as_restructured_text(None, what, name, None, None, lines)
    return lines


def test_indented_code_becomes_a_block_of_code():
    told = as_read("Find it.\n\n    a = b_ | c\n\nMore.\n\nArgs:\n    x: Of |y| and z_.")
    assert told[:6] == ["Find it.", "", "", ".. code-block:: python", "", "    a = b_ | c"]
    assert told[-2:] == ["Args:", r"    x: Of \|y\| and z\_."]


def test_what_is_marked_as_code_stays():
    assert as_read("Of `a_ | b_` and ``c_``.") == ["Of `a_ | b_` and ``c_``."]


def test_a_property_keeps_its_colons():
    as_read("[m] One end: a disc.", "property", "some.property")
    made_of_it = ["a disc.", "", ":type: [m] One end"]
    docstrings.with_colons(None, "property", "some.property", None, None, made_of_it)
    assert made_of_it == ["[m] One end: a disc."]


def test_links_that_lead_nowhere_are_found(tmp_path):
    (tmp_path / "b.html").write_text('<h1 id="there">b</h1><a href="https://example.org/x">out</a>')
    (tmp_path / "a.html").write_text(
        '<a href="b.html#there">1</a><a href="b.html#gone">2</a><a href="c.html">3</a><img src="d.png">'
    )
    assert local_links.faults(tmp_path) == [
        "a.html: b.html#gone: there is no such heading",
        "a.html: c.html: there is no such file",
        "a.html: d.png: there is no such file",
    ]


@pytest.mark.parametrize("entry", gallery.entries(), ids=lambda entry: entry.name)
def test_the_commands_of_the_gallery_are_taken(entry):
    assert [why for command in entry.commands if (why := commands.wrong(command))] == []


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("doxygen") is None, reason="no Doxygen: a package of the extra docs")
def test_the_site_builds_without_a_warning_or_a_broken_link(tmp_path):
    pytest.importorskip("sphinx")
    env = {**os.environ, "PYTHON": sys.executable}
    words = [ROOT / "scripts/docs", "--site", tmp_path / "site", "--quick"]
    done = subprocess.run(words, env=env, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr
    for page in ("index", "reference/mcplan.ddp", "reference/cpp_ddp", "docs/tutorials/01_first_plan", "search"):
        assert (tmp_path / f"site/{page}.html").exists()
    assert "committed_s" in (tmp_path / "site/reference/cpp_ddp.html").read_text(encoding="utf-8")
