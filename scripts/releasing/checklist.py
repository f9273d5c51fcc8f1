"""The command line of `scripts/release`: the points of a release, each checked, none changed."""

from __future__ import annotations

import argparse
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


def version() -> str:
    """The version, from the one place where it stands."""
    text = (ROOT / "cpp/include/mcplan/version.hpp").read_text(encoding="utf-8")
    (found,) = re.findall(r'#define MCPLAN_VERSION "(.+)"', text)
    return found


def changelog() -> Iterator[str]:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    if not re.search(rf"(?m)^## \[{re.escape(version())}\] - \d{{4}}-\d\d-\d\d$", text):
        yield f"CHANGELOG.md has no dated heading for {version()}"
    unreleased = re.search(r"(?ms)^## \[Unreleased\]\n(.*?)(?=^## |\Z)", text)
    if unreleased and unreleased[1].strip():
        yield f"CHANGELOG.md has entries under Unreleased: they are not of {version()}"


def tag() -> Iterator[str]:
    tags = _run("git", "tag", "--points-at", "HEAD").stdout.split()
    if f"v{version()}" not in tags:
        yield f"HEAD has no tag v{version()}"
    if _run("git", "status", "--porcelain").stdout.strip():
        yield "the work tree has changes that are not committed"


def lock_files() -> Iterator[str]:
    newer = ROOT / "pyproject.toml"
    extras = re.search(r"(?m)^for extra in (.+); do$", (ROOT / "scripts/lock").read_text(encoding="utf-8"))
    for extra in extras[1].split() if extras else []:
        path = ROOT / f"requirements/{extra}.lock"
        if not path.exists():
            yield f"{path.name} is missing: scripts/lock"
            continue
        committed = [_run("git", "log", "-1", "--format=%ct", "--", str(each)).stdout.strip() for each in (path, newer)]
        if not all(committed):
            yield f"{path.name} is not committed"


def stubs() -> Iterator[str]:
    python = os.environ.get("PYTHON", str(ROOT / ".venv/bin/python"))
    done = _run(python, "-m", "pytest", "-q", "tests/python/test_stubs.py", "tests/python/test_option_types.py")
    if done.returncode:
        yield f"stubs or option types are stale: scripts/stubs ({done.stdout.strip().splitlines()[-1:]})"


def pages() -> Iterator[str]:
    done = _run("scripts/docs", "--check")
    if done.returncode:
        yield f"scripts/docs --check: {(done.stderr or done.stdout).strip().splitlines()[0]}"


def wheels() -> Iterator[str]:
    for python in PYTHONS:
        found = list((ROOT / "dist").glob(f"mcplan-{version()}-cp{python.replace('.', '')}-*manylinux*.whl"))
        if len(found) != 1:
            yield f"dist/ has {len(found)} wheels of {version()} for Python {python}: scripts/wheels {python}"


def twine() -> Iterator[str]:
    files = [str(path) for path in sorted((ROOT / "dist").glob("*.whl"))]
    if not files:
        yield "no wheel in dist/"
        return
    done = _run(sys.executable, "-m", "twine", "check", "--strict", *files)
    if done.returncode:
        yield f"twine check: {(done.stdout + done.stderr).strip().splitlines()[-1]}"


def bills() -> Iterator[str]:
    """Each wheel has a bill of materials of its own version that CycloneDX's schema accepts."""
    for path in sorted((ROOT / "dist").glob("*.whl")):
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
    if not list((ROOT / "dist").glob(f"libmcplan-dev_{version()}*.deb")):
        yield f"dist/ has no libmcplan-dev of {version()}: scripts/deb"


QUICK: dict[str, Callable[[], Iterator[str]]] = {"changelog": changelog, "tag": tag, "lock files": lock_files}
REST: dict[str, Callable[[], Iterator[str]]] = {
    "stubs": stubs,
    "docs": pages,
    "wheels": wheels,
    "twine check": twine,
    "bill of materials": bills,
    "Debian package": debian,
}


def _run(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


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
    print(f"release {version()}")
    for name, check in (QUICK if given.quick else QUICK | REST).items():
        try:
            found = list(check())
        except (ImportError, OSError) as error:  # a tool that is not there leaves the point open
            found = [f"could not be checked: {error}"]
        print(f"{'open' if found else 'done'}  {name}{''.join(chr(10) + '      ' + each for each in found)}")
        open_points += bool(found)
    return 1 if open_points else 0


if __name__ == "__main__":
    sys.exit(main())
