"""requirements/*.lock satisfy the ranges of pyproject.toml, for every extra and every Python and system that mcplan supports."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from packaging.markers import Marker
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name
from packaging.version import Version

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).resolve().parents[2]
with (ROOT / "pyproject.toml").open("rb") as file:
    DATA = tomllib.load(file)
PROJECT, BUILD = DATA["project"], DATA["build-system"]["requires"]
EXTRAS: dict[str, list[str]] = PROJECT["optional-dependencies"]
#: Extras with a file of their own: all but those that only name others.
LOCKED = [name for name, needs in EXTRAS.items() if any(Requirement(need).name != "mcplan" for need in needs)]
PYTHONS = ["3.10", "3.11", "3.12", "3.13"]
SYSTEMS = [("linux", "Linux"), ("darwin", "Darwin")]


def environments() -> Iterator[dict[str, str]]:
    for version in PYTHONS:
        for platform, system in SYSTEMS:
            names = {"python_version": version, "python_full_version": f"{version}.1", "sys_platform": platform}
            machine = {"platform_machine": "x86_64", "platform_python_implementation": "CPython", "os_name": "posix"}
            yield {**names, **machine, "platform_system": system, "implementation_name": "cpython", "extra": ""}


def needs_of(extra: str) -> list[Requirement]:
    """What an extra asks for, with what the project itself and its build do, and the extras that it names."""
    out = [Requirement(text) for text in [*PROJECT["dependencies"], *BUILD]]
    for requirement in map(Requirement, EXTRAS[extra]):
        if requirement.name == PROJECT["name"]:
            for other in requirement.extras:
                out += needs_of(other)
        else:
            out.append(requirement)
    return out


def locked(text: str) -> list[tuple[Requirement, int]]:
    """The pinned packages of a lock file, each with the number of its hashes."""
    found = []
    for entry in re.split(r"\n(?=\S)", re.sub(r"(?m)^#.*\n", "", text).strip()):
        lines = [line.strip().removesuffix("\\").strip() for line in entry.splitlines()]
        hashes = [line for line in lines[1:] if re.fullmatch(r"--hash=sha256:[0-9a-f]{64}", line)]
        assert len(hashes) == len(lines) - 1, entry
        found.append((Requirement(lines[0]), len(hashes)))
    return found


def applies(marker: Marker | None, environment: dict[str, str]) -> bool:
    return marker is None or marker.evaluate(environment)


def missing(needs: list[Requirement], pins: list[Requirement]) -> list[str]:
    """What a lock lacks: a package that has no pin, more than one, or one out of its range, in some environment."""
    out = []
    for environment in environments():
        pinned: dict[str, list[Version]] = {}
        for pin in pins:
            (specifier,) = pin.specifier
            if applies(pin.marker, environment):
                pinned.setdefault(canonicalize_name(pin.name), []).append(Version(specifier.version))
        for need in needs:
            if applies(need.marker, environment):
                versions = pinned.get(canonicalize_name(need.name), [])
                if len(versions) != 1 or not need.specifier.contains(versions[0], prereleases=True):
                    where = f"Python {environment['python_version']} on {environment['sys_platform']}"
                    out.append(f"{need}: locked at {', '.join(map(str, versions)) or 'nothing'} for {where}")
    return out


def read(extra: str) -> list[Requirement]:
    return [pin for pin, _ in locked((ROOT / f"requirements/{extra}.lock").read_text())]


def test_every_extra_with_packages_has_a_lock_and_no_lock_is_left_over() -> None:
    assert {path.stem for path in (ROOT / "requirements").glob("*.lock")} == set(LOCKED)
    script = re.search(r"^for extra in (.+); do$", (ROOT / "scripts/lock").read_text(), re.MULTILINE)
    assert script and set(script[1].split()) == set(LOCKED)


@pytest.mark.parametrize("extra", LOCKED)
def test_a_lock_has_one_version_within_the_range_of_everything_that_is_asked_for(extra: str) -> None:
    assert missing(needs_of(extra), read(extra)) == []


@pytest.mark.parametrize("extra", LOCKED)
def test_every_package_of_a_lock_is_pinned_exactly_and_has_hashes(extra: str) -> None:
    for pin, hashes in locked((ROOT / f"requirements/{extra}.lock").read_text()):
        assert [specifier.operator for specifier in pin.specifier] == ["=="] and hashes > 0, pin


def disagreements(locks: dict[str, list[Requirement]]) -> list[str]:
    """Packages that two locks pin to different versions in one and the same environment."""
    out = []
    for environment in environments():
        seen: dict[str, tuple[str, str]] = {}
        for extra, pins in locks.items():
            for pin in pins:
                if applies(pin.marker, environment):
                    other, version = seen.setdefault(canonicalize_name(pin.name), (extra, str(pin.specifier)))
                    if version != str(pin.specifier):
                        out.append(f"{pin.name}: {other} has {version}, {extra} {pin.specifier}")
    return out


def test_locks_have_the_same_versions_so_that_they_can_be_installed_together() -> None:
    assert disagreements({extra: read(extra) for extra in LOCKED}) == []


def test_locks_that_disagree_are_seen_where_both_apply() -> None:
    old, new = Requirement("a==1; python_version < '3.11'"), Requirement("a==2; python_version >= '3.11'")
    assert disagreements({"dev": [old, new], "docs": [new]}) == []
    assert "a: dev has ==1, docs ==2" in disagreements({"dev": [old], "docs": [Requirement("a==2")]})


def test_supported_pythons_are_those_of_the_project() -> None:
    assert all(Version(version) in SpecifierSet(PROJECT["requires-python"]) for version in PYTHONS)
    assert Version("3.9") not in SpecifierSet(PROJECT["requires-python"])


def test_a_lock_that_does_not_fit_is_seen() -> None:
    pins = [
        pin for pin, _ in locked("a==1.0 ; python_version < '3.11' \\\n    --hash=sha256:" + 64 * "0" + "\nb==2.0\n")
    ]
    assert [str(pin) for pin in pins] == ['a==1.0; python_version < "3.11"', "b==2.0"]
    assert len(missing([Requirement("a>=1")], pins)) == 2 * 3  # from Python 3.11 on nothing is pinned
    assert missing([Requirement("b>=2"), Requirement("a; python_version < '3.11'")], pins) == []
    assert missing([Requirement("b<2")], pins)[0] == "b<2: locked at 2.0 for Python 3.10 on linux"
