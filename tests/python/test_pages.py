"""`scripts/docs` finds what pages say that is not so, and the pages of this repository say nothing of the kind."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

pytest.importorskip("mcplan.tracking.options")
from pages import commands, links, made, names, pictures, stated, tables  # noqa: E402
from pages.page import Page  # noqa: E402


def page(text: str, path: Path = ROOT / "docs/a_page.md") -> Page:
    return Page(path, text, text)


def docs(*arguments: str) -> subprocess.CompletedProcess[str]:
    env = {**os.environ, "PYTHON": sys.executable}
    return subprocess.run([ROOT / "scripts/docs", *arguments], env=env, capture_output=True, text=True, cwd=ROOT)


def test_no_page_is_stale():
    done = docs("--check")
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_no_page_is_stale_in_what_takes_a_plan_or_a_simulation():
    done = docs("--check", "--slow")
    assert done.returncode == 0, done.stderr


def test_a_number_that_the_code_has_otherwise_is_put_right_and_nothing_else():
    found = page("Switches save\na fraction of $10^{-5}$, at most seven of them, see 0.70.")
    assert stated.state(found, "a fraction of $10^{{}}$, at most {} of them, see {}", ["-4", "6", "0.7"]) is None
    assert found.text == "Switches save\na fraction of $10^{-4}$, at most six of them, see 0.70."


@pytest.mark.parametrize(
    ("text", "wanted"), [("0.13", 0.1349), ("4,000", 4000), ("−1", -1.0), ("1e-3", 0.001), ("Three", 3), ("0.80", 0.8)]
)
def test_a_number_stands_as_long_as_it_agrees_to_its_own_digits(text, wanted):
    assert stated.written(text, wanted) == text


def test_a_sentence_that_is_gone_is_reported():
    assert "no longer says" in stated.state(page("Nothing."), "at most {} of them", ["6"])


def test_a_default_that_the_code_has_otherwise_is_put_right():
    head = "<!-- defaults of: rhp.Options -->\n| option | default |\n|---|---|\n"
    found = page(head + "| `lookahead`, `com_height` | 4, (0.87, 1.15) |\n| `paper` | no |\n")
    assert tables.refresh(found) == []
    assert found.text == head + "| `lookahead`, `com_height` | 3, (0.87, 1.15) |\n| `paper` | no |\n"


def test_an_option_that_does_not_exist_is_reported():
    found = page("<!-- defaults of: rhp.Options -->\n| option | default |\n|---|---|\n| `lokahead` | 3 |\n")
    assert "no lokahead" in tables.refresh(found)[0]


def test_a_row_that_goes_on_with_the_one_above_it_has_no_default():
    head = "<!-- defaults of: rhp.Options -->\n| option | default | what |\n|---|---|---|\n"
    found = page(head + "| `lookahead` | 3 | steps, |\n| | | the executed one too |\n")
    assert tables.refresh(found) == [] and found.text == found.on_disk


def test_pictures_are_listed_with_their_commands():
    text = (
        "- [images/a.png](images/a.png): `out/b.png` of\n  - `mcplan demo --out out`\n  - `python -m x out b`\n- else\n"
    )
    picture = pictures.Picture("images/a.png", ("mcplan demo --out out", "python -m x out b"), "out/b.png")
    assert pictures.listed(text) == [picture]
    assert pictures.listed(pictures.LIST.read_text(encoding="utf-8"))


def test_a_table_names_all_and_nothing_else():
    found = page("<!-- rows are: planar robots -->\n| robot |\n|---|\n| `climber9` |\n| `walker8` |\n")
    assert "walker9" in tables.refresh(found)[0] and "walker8" in tables.refresh(found)[0]


def test_a_block_is_what_its_command_prints():
    found = page("<!-- made by: mcplan version -->\nold\n<!-- end -->\n")
    assert made.refresh(found, slow=False) == []
    assert "$ mcplan version\n" in found.text and "old" not in found.text
    again = page(found.text)
    assert made.refresh(again, slow=False) == [] and again.text == found.text


def test_a_block_whose_command_fails_is_reported_and_stands():
    found = page("<!-- made by: mcplan scenes nowhere -->\nold\n<!-- end -->\n")
    assert "nowhere" in made.refresh(found, slow=False)[0]
    assert found.text == found.on_disk


def test_times_on_the_clock_are_not_compared_and_other_numbers_are():
    assert made.same("solved after 1.20 s, cost 3.1\n", "solved after 0.90 s, cost 3.1\n")
    assert not made.same("at 1.20 s\n", "at 0.90 s\n")
    assert made.same("at 1.20 s, 574 N\n", "at 1.21 s, 580 N\n", 0.02)
    assert not made.same("at 1.20 s, 574 N\n", "at 1.21 s, 680 N\n", 0.02)
    assert not made.same("left knee 1\n", "right knee 1\n", 0.02)


def test_times_on_the_clock_stay_when_the_rest_is_made_again():
    old, new = "at 1 s, 0.60 ms a step, 2.39 times real time", "at 2 s, 3.95 ms a step, 0.39 times real time"
    assert made.with_clock_of(old, new) == "at 2 s, 0.60 ms a step, 2.39 times real time"
    assert made.with_clock_of("nothing", new) == new


def test_measurements_without_a_date_are_reported():
    assert "no date" in made.refresh(page("<!-- begin: mcplan bench -->\n1 ms\n<!-- end: mcplan bench -->\n"), False)[0]
    assert (
        made.refresh(page("<!-- begin: mcplan bench -->\n2026-11-21: 1 ms\n<!-- end: mcplan bench -->\n"), False) == []
    )


@pytest.mark.parametrize(
    "command",
    [
        "mcplan plann flat",
        "mcplan plan flat --no-such-option",
        "mcplan plan flatt",
        "mcplan plan flat --time-limit soon",
        "mcplan plan flat --robot tallos",
        "mcplan sip walkin",
        "mcplan scenes gap, mcplan scenes flat",
        "mcplan bench contact",
        "mcplan reproduce lengange",
    ],
)
def test_a_command_that_would_be_refused_is_reported(command):
    assert commands.wrong(command)


@pytest.mark.parametrize(
    "command",
    [
        "mcplan",
        "mcplan plan stairs --robot talos -o plan.npz",
        "mcplan plan my_scene.toml --robot my_robot.toml",
        "mcplan scenes NAME --html FILE",
        "mcplan bench robustness --scenes 0",
    ],
)
def test_a_command_that_works_is_not_reported(command):
    assert commands.wrong(command) is None


def test_commands_are_read_from_blocks_and_from_sentences():
    block = "```\n$ mcplan plan flat  # a comment\nmcplan rhp rubbles \\\n  --cycles 3 && mcplan check x.npz\n```\n"
    text = f"See `mcplan demo`.\n\n{block}"
    assert [command for _, command in commands.spoken_of(page(text))] == [
        "mcplan demo",
        "mcplan plan flat",
        "mcplan rhp rubbles     --cycles 3",
        "mcplan check x.npz",
    ]


@pytest.mark.parametrize("link", ["nowhere.md", "#no-such-heading", "tracking.md#no-such-heading"])
def test_a_link_that_leads_nowhere_is_reported(link):
    assert links.faults(page(f"# A page\n\n[see]({link})\n"))
    assert links.faults(page(f"# A page\n\n[see][it]\n\n[it]: {link}\n"))


def test_links_that_lead_somewhere_are_not_reported():
    assert links.faults(page("# A page\n\n[see](tracking.md#quick-start), [it][index]\n\n[index]: index.md\n")) == []


def test_a_table_may_be_wide_where_a_benchmark_writes_it_and_nowhere_else():
    wide = f"| {'x' * 200} |\n"
    assert links.faults(page(f"<!-- begin: mcplan bench -->\n{wide}<!-- end: mcplan bench -->\n")) == []
    assert "204 columns" in links.faults(page(wide))[0]
    assert "204 columns" in links.faults(page(f"<!-- begin: mcplan bench -->\n<!-- end: mcplan bench -->\n{wide}"))[0]


def test_headings_that_sources_name_are_found():
    assert "closed-form" in links.anchors(ROOT / "docs/theory/ddp.md")
    assert links.source_faults() == []


def test_a_line_that_is_too_long_is_reported():
    assert "140 columns" in links.faults(page("x" * 140))[0]


@pytest.mark.parametrize("name", ["cpp/src/ddp/serch.cpp", "mcplan.plann", "test_nothing_of_the_kind"])
def test_a_name_that_nothing_has_is_reported(name):
    assert names.wrong(name)


def test_a_python_block_that_calls_what_is_not_there_is_reported():
    assert names.wrong_block("import mcplan as mp\nmp.plann(mp.load_scene('gap'))\n") == ["there is no mp.plann"]
    assert names.wrong_block("mp.plan(\n")
