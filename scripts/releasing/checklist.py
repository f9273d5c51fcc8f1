"""The command line of `scripts/release`: the points of a release, each checked, none changed."""

from __future__ import annotations

import argparse
import datetime
import json
import os
import re
import subprocess
import sys
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHONS = ("3.10", "3.11", "3.12", "3.13", "3.14")


class Unknown(Exception):
    """What a point asks for cannot be told; the message says why."""


def version() -> str:
    """The version, from the one place where it stands.

    Raises:
        Unknown: It does not stand there, or is none of a release.
    """
    path = "cpp/include/mcplan/version.hpp"
    found = re.findall(r'(?m)^#define MCPLAN_VERSION "(.*)"$', (ROOT / path).read_text(encoding="utf-8"))
    if len(found) != 1:
        raise Unknown(f"{path} must have one line '#define MCPLAN_VERSION \"X.Y.Z\"', it has {len(found)}")
    if not re.fullmatch(r"\d+\.\d+\.\d+", found[0]):
        raise Unknown(f"{path}: the version must be X.Y.Z, got {found[0]!r}")
    return found[0]


def changelog() -> Iterator[str]:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    dates = re.findall(rf"(?m)^## \[{re.escape(version())}\] - (\S+)$", text)
    if len(dates) != 1:
        yield f"CHANGELOG.md has {len(dates) or 'no'} dated heading{'s' if dates else ''} for {version()}"
    for date in dates:
        try:
            datetime.date.fromisoformat(date)
        except ValueError:
            yield f"CHANGELOG.md: the date of {version()} must be YYYY-MM-DD, got {date}"
    unreleased = re.search(r"(?ms)^## \[Unreleased\]\n(.*?)(?=^## |\Z)", text)
    if unreleased and unreleased[1].strip():
        yield f"CHANGELOG.md has entries under Unreleased: they are not of {version()}"


def tag() -> Iterator[str]:
    name = f"v{version()}"
    if name not in _git("tag", "--points-at", "HEAD").split():
        elsewhere = _git("tag", "--list", name).strip()
        yield f"the tag {name} is on another commit than HEAD" if elsewhere else f"HEAD has no tag {name}"
    if changes := _git("status", "--porcelain").splitlines():
        names = ", ".join(line[3:] for line in changes[:3]) + (", ..." if len(changes) > 3 else "")
        yield f"the work tree has changes that are not committed: {names}"


def lock_files() -> Iterator[str]:
    """Each is there and committed; that it satisfies the ranges of pyproject.toml is a test of its own."""
    extras = re.search(r"(?m)^for extra in (.+); do$", (ROOT / "scripts/lock").read_text(encoding="utf-8"))
    for extra in extras[1].split() if extras else []:
        path = ROOT / f"requirements/{extra}.lock"
        if not path.exists():
            yield f"{path.name} is missing: scripts/lock"
            continue
        if not _git("ls-files", "--", str(path)).strip():
            yield f"{path.name} is not committed"


def ranges() -> Iterator[str]:
    if failure := _tests("requirements"):
        yield f"lock files do not fit pyproject.toml: scripts/lock ({failure})"


def stubs() -> Iterator[str]:
    if failure := _tests("stubs", "option_types"):
        yield f"stubs or option types are stale: scripts/stubs ({failure})"


def pages() -> Iterator[str]:
    done = _run("scripts/docs", "--check")
    if done.returncode:
        yield f"scripts/docs --check: {_last(done)}"


def wheels() -> Iterator[str]:
    for python in PYTHONS:
        found = list((ROOT / "dist").glob(f"mcplan-{version()}-cp{python.replace('.', '')}-*manylinux*.whl"))
        if len(found) != 1:
            yield f"dist/ has {len(found)} wheels of {version()} for Python {python}: scripts/wheels {python}"
    for path in sorted((ROOT / "dist").glob("*.whl")):
        if not path.name.startswith(f"mcplan-{version()}-"):
            yield f"dist/ has a wheel of something else: {path.name}"


def twine() -> Iterator[str]:
    files = [str(path) for path in sorted((ROOT / "dist").glob("*.whl"))]
    if not files:
        yield "no wheel in dist/"
        return
    done = _run(sys.executable, "-m", "twine", "check", "--strict", *files)
    if done.returncode:
        yield f"twine check: {_last(done)}"


def bills() -> Iterator[str]:
    """Each wheel has a bill of materials of its own version that CycloneDX's schema accepts."""
    paths = sorted((ROOT / "dist").glob("*.whl"))
    if not paths:
        yield "no wheel in dist/"
    for path in paths:
        with zipfile.ZipFile(path) as wheel:
            names = [name for name in wheel.namelist() if name.endswith("/sboms/mcplan.cdx.json")]
            if len(names) != 1:
                yield f"{path.name}: no bill of materials"
                continue
            text = wheel.read(names[0]).decode()
        if json.loads(text)["metadata"]["component"]["version"] != version():
            yield f"{path.name}: its bill of materials is of another version"
        from cyclonedx.schema import SchemaVersion  # type: ignore[import-not-found]
        from cyclonedx.validation.json import JsonStrictValidator  # type: ignore[import-not-found]

        error = JsonStrictValidator(SchemaVersion.V1_6).validate_str(text)
        if error:
            yield f"{path.name}: {str(error).splitlines()[0][:200]}"


def debian() -> Iterator[str]:
    found = list((ROOT / "dist").glob(f"libmcplan-dev_{version()}_*.deb"))
    if len(found) != 1:
        yield f"dist/ has {len(found) or 'no'} libmcplan-dev of {version()}: scripts/deb"


QUICK: dict[str, Callable[[], Iterator[str]]] = {"changelog": changelog, "tag": tag, "lock files": lock_files}
REST: dict[str, Callable[[], Iterator[str]]] = {
    "ranges of lock files": ranges,
    "stubs": stubs,
    "docs": pages,
    "wheels": wheels,
    "twine check": twine,
    "bill of materials": bills,
    "Debian package": debian,
}


def _run(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


def _git(*words: str) -> str:
    """What git prints.

    Raises:
        Unknown: It refuses, as outside of a repository.
    """
    done = _run("git", *words)
    if done.returncode:
        raise Unknown(f"git {words[0]}: {_last(done)}")
    return done.stdout


def _tests(*names: str) -> str:
    """How tests of tests/python ended; "": well."""
    python = os.environ.get("PYTHON", str(ROOT / ".venv/bin/python"))
    done = _run(python, "-m", "pytest", "-q", *(f"tests/python/test_{name}.py" for name in names))
    return _last(done) if done.returncode else ""


def _last(done: subprocess.CompletedProcess[str]) -> str:
    """The last line that a program has printed, its errors before all else."""
    lines = (done.stderr.strip() or done.stdout.strip()).splitlines()
    return lines[-1] if lines else f"exit code {done.returncode}"


def _found(check: Callable[[], Iterator[str]]) -> list[str]:
    """What is open of a point, also where it cannot be checked."""
    found: list[str] = []
    try:
        found.extend(check())
    except OSError as error:
        found.append(f"could not be checked: {error.filename}: {error.strerror}" if error.filename else str(error))
    except (ImportError, Unknown, ValueError, KeyError, zipfile.BadZipFile) as error:  # no such tool, or a broken file
        found.append(f"could not be checked: {error}")
    return found


def main(arguments: list[str] | None = None) -> int:
    """Print a line for each point.

    Returns:
        0 when all hold, 1 when one is open.
    """
    parser = argparse.ArgumentParser(prog="scripts/release", description=__doc__)
    parser.add_argument("--check", action="store_true", required=True, help="Check each point; nothing is changed.")
    parser.add_argument("--quick", action="store_true", help="Only version, changelog, tag and lock files.")
    given = parser.parse_args(arguments)
    open_points = 0
    try:
        print(f"release {version()}")
    except (OSError, Unknown) as error:
        print(f"open  version\n      {error}")
        return 1
    for name, check in (QUICK if given.quick else QUICK | REST).items():
        found = _found(check)
        print(f"{'open' if found else 'done'}  {name}{''.join(chr(10) + '      ' + each for each in found)}")
        open_points += bool(found)
    return 1 if open_points else 0


if __name__ == "__main__":
    sys.exit(main())
