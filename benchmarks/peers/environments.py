"""Environments of the peers, apart from mcplan's: made once, in build/peers."""

from __future__ import annotations

import os
import subprocess
import venv
from pathlib import Path


class Unavailable(Exception):
    """A peer cannot be had on this machine; the text says why."""


def python_with(folder: Path, packages: tuple[str, ...]) -> Path:
    """Python of an environment with these packages.

    Raises:
        Unavailable: They cannot be installed.
    """
    python, ready = folder / "bin/python", folder / "ready"
    if not ready.exists():
        venv.create(folder, with_pip=True, clear=True)
        run(python, "-m", "pip", "install", "--quiet", *packages)
        ready.touch()
    return python


def run(*words: str | Path) -> str:
    """Standard output of a command, on one thread, that sees nothing of mcplan's environment.

    Raises:
        Unavailable: It fails; its last line is told.
    """
    env = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "LD_LIBRARY_PATH")}
    done = subprocess.run(
        [str(word) for word in words], env=env | {"OMP_NUM_THREADS": "1"}, capture_output=True, text=True
    )
    if done.returncode:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise Unavailable(f"{Path(words[0]).name} {words[1]}: {said[-1] if said else f'exit code {done.returncode}'}")
    return done.stdout


def sources(folder: Path, given: Path | None, name: str, url: str, commit: str) -> Path:
    """The source tree of a peer that is no package: `given`/`name` if that is there, else a clone at the commit.

    Raises:
        Unavailable: It cannot be cloned.
    """
    tree = given / name if given else folder / name
    if not tree.exists():
        run("git", "clone", "--quiet", url, tree)
        run("git", "-C", tree, "checkout", "--quiet", commit)
    return tree
