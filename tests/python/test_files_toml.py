"""mcplan.files.toml: what is written reads back as the same values."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mcplan as mp
from mcplan.errors import InvalidInput
from mcplan.files.toml import toml_text
from plain_toml import tomllib

text = st.text(st.characters(codec="utf-8"))
plain = text | st.booleans() | st.integers(-(2**63), 2**63 - 1) | st.floats(allow_nan=False)
table = st.dictionaries(text, plain | st.lists(plain) | st.dictionaries(text, plain, max_size=2))


@given(st.dictionaries(text, plain | st.lists(plain) | table | st.lists(table, min_size=1)))
def test_what_is_written_reads_back(data):
    assert tomllib.loads(toml_text(data, header="comment\n\nmore")) == data


def test_long_lists_take_a_line_an_entry():
    written = toml_text({"vertices": [[float(i), 0.123456789, -0.123456789] for i in range(6)]})
    assert written.count("\n") == 8
    assert max(map(len, written.splitlines())) < 60


@given(st.text())
def test_no_header_spoils_the_file(header):
    """Also one with control characters, or with bytes of a file's name that are no text."""
    assert tomllib.loads(toml_text({"a": 1}, header).encode().decode()) == {"a": 1}


def test_headers_of_names_that_are_no_text_are_written():
    written = toml_text({"a": 1}, "Made by: mcplan scenes \udcc3\udcb6.toml \x1b[31m\nname = 'evil'")
    assert tomllib.loads(written.encode("utf-8").decode()) == {"a": 1}


READERS = {
    "gravity": mp.load_scene,
    "mass": mp.load_robot,
    "bodies": mp.load_planar_robot,
    "phases": mp.load_planar_task,
}
LITERALS = ("true", '"x"', '"it\'s"', '{ a = [true, 1], "b c" = {} }', "2026-01-01", "07:32:00.500000000")


@pytest.mark.parametrize("literal", LITERALS)
@pytest.mark.parametrize(("key", "load"), READERS.items(), ids=READERS)
def test_errors_show_a_value_as_the_file_writes_it(key, load, literal, tmp_path):
    (tmp_path / "bad.toml").write_text(f"{key} = {literal}\n")
    with pytest.raises(InvalidInput) as found:
        load(tmp_path / "bad.toml")
    kind = "number" if key in ("gravity", "mass") else "list"
    assert f"{tmp_path / 'bad.toml'}: {key}: must be a {kind}, got {literal}" in str(found.value).splitlines()
