"""What is shipped says what is inside: each bundled library has its notice, the version stands once, scripts have a help."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from releasing import checklist, components, sbom, wheel  # noqa: E402

#: What auditwheel copied into the wheel for Python 3.11 on Debian 12; zlib, libstdc++ and libgcc_s are the system's.
BUNDLED = """libblas-8d5488a6.so.3.11.0 libbz2-e4f501c8.so.1.0.4 libdmumps_seq-5-14eb3711.5.0.so libesmumps-7-1ab67439.0.3.so
libgfortran-59811b6f.so.5.0.0 libgomp-f9a9ad78.so.1.0.0 libipopt-96e13272.so.1.9.9 liblapack-72db5f4e.so.3.11.0
liblzma-aaead752.so.5.4.1 libmumps_common_seq-5-85c35575.5.0.so libquadmath-8c3e1296.so.0.0.0
libscotch-7-f76822b3.0.3.so libscotcherr-7-6c75d6e1.0.3.so""".split()


def test_every_bundled_library_has_a_component() -> None:
    names = {component.name for component in components.components_of(BUNDLED)}
    assert names == {component.name for component in components.COMPONENTS}


def test_a_library_without_notice_is_refused_by_name() -> None:
    with pytest.raises(components.MissingNotice, match="libopenblas-12345678.so.0"):
        components.components_of([*BUNDLED, "libopenblas-12345678.so.0"])


def test_every_component_is_in_the_third_party_notes() -> None:
    notes = (ROOT / "third_party_notes.md").read_text(encoding="utf-8")
    aliases = {
        "GCC runtime for OpenMP": "libgomp",
        "XZ Utils (liblzma)": "XZ Utils",
        "JSON for Modern C++": "JSON for Modern",
    }
    assert [each.name for each in components.COMPONENTS if aliases.get(each.name, each.name) not in notes] == []


def test_texts_that_components_name_are_there() -> None:
    named = {text for component in components.COMPONENTS for text in component.texts}
    assert named == {path.name for path in (ROOT / "scripts/releasing/texts").iterdir()}


def test_the_bill_of_materials_names_each_library_once_and_refers_to_what_it_has() -> None:
    hashes = {name: 64 * "0" for name in BUNDLED}
    versions = {component.name: "1.0" for component in components.COMPONENTS}
    bill = sbom.bill("9.9.9", hashes, ["numpy", "typer", "rich"], versions)
    files = [file["name"] for each in bill["components"] for file in each.get("components", [])]
    assert sorted(files) == sorted(BUNDLED)
    refs = [each["bom-ref"] for each in bill["components"]]
    assert len(set(refs)) == len(refs) and set(bill["dependencies"][0]["dependsOn"]) == set(refs)
    assert {"numpy", "typer", "rich"} <= {each["name"] for each in bill["components"]}
    assert json.loads(json.dumps(bill)) == bill


def test_record_of_a_wheel_has_the_hash_of_each_file() -> None:
    # SHA-256 of the empty string, a known constant, in URL-safe base 64.
    text = wheel.record({"a": b""}, "x.dist-info").decode()
    assert text == "a,sha256=47DEQpj8HBSa-_TImW-5JCeuQeRkm5NMpJWZG3hSuFU,0\nx.dist-info/RECORD,,\n"


@pytest.mark.parametrize("script", ["wheels", "deb", "release", "test_exports"])
def test_scripts_say_how_they_are_used(script: str) -> None:
    done = subprocess.run([ROOT / "scripts" / script, "--help"], capture_output=True, text=True)
    assert done.returncode == 0 and f"scripts/{script}" in done.stdout


def test_the_version_is_written_in_one_place() -> None:
    """Neither builds nor package metadata repeat it; what reads it names the header."""
    header = "cpp/include/mcplan/version.hpp"
    for name in ("pyproject.toml", "bench/pyproject.toml", "CMakeLists.txt", "CITATION.cff", "scripts/deb"):
        text = (ROOT / name).read_text(encoding="utf-8")
        assert not re.search(r'(?m)^\s*(version|VERSION)\s*[=: ]\s*"?\d', text), name
        assert "version.hpp" in text or name == "CITATION.cff", name
    sources = [*(ROOT / "cpp").rglob("*.[ch]pp"), *(ROOT / "python").rglob("*.py")]
    found = [
        str(path.relative_to(ROOT)) for path in sources if re.search(r'VERSION "\d', path.read_text(encoding="utf-8"))
    ]
    assert found == [header]


def test_wheels_that_lie_in_dist_carry_notices_and_a_bill() -> None:
    wheels = sorted((ROOT / "dist").glob("mcplan-*manylinux*.whl"))
    if not wheels:
        pytest.skip("no wheel in dist/: scripts/wheels")
    for path in wheels:
        assert wheel.faults(path) == []
        with zipfile.ZipFile(path) as held:
            assert held.testzip() is None
            assert len([name for name in held.namelist() if name.endswith("/sboms/mcplan.cdx.json")]) == 1


@pytest.mark.parametrize(
    ("header", "changes", "told"),
    [
        (None, "", ["open  version", "No such file"]),
        ("", "", ["open  version", "must have one line", "it has 0"]),
        ('#define MCPLAN_VERSION "1.0 beta"', "", ["the version must be X.Y.Z, got '1.0 beta'"]),
        ('#define MCPLAN_VERSION "1.2.3"', None, ["CHANGELOG.md: No such file"]),
        ('#define MCPLAN_VERSION "1.2.3"', "## [1.2.4] - 2026-01-02\n", ["CHANGELOG.md has no dated heading for 1.2.3"]),
        ('#define MCPLAN_VERSION "1.2.3"', "## [1.2.3] - 2026-13-02\n", ["must be YYYY-MM-DD, got 2026-13-02"]),
        ('#define MCPLAN_VERSION "1.2.3"', "## [1.2.3] - 2026-01-02\n", ["done  changelog", "open  tag", "git tag: fatal"]),
    ],
)  # fmt: skip
def test_the_checklist_of_a_release_says_what_is_missing(header, changes, told, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(checklist, "ROOT", tmp_path)
    for name, text in (("cpp/include/mcplan/version.hpp", header), ("CHANGELOG.md", changes)):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        if text is not None:
            (tmp_path / name).write_text(text)
    assert checklist.main(["--check", "--quick"]) == 1
    printed = capsys.readouterr().out
    assert [part for part in told if part not in printed] == []
