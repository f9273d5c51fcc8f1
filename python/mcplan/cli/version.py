"""mcplan version"""

from __future__ import annotations

import re
from pathlib import Path

#: Shared libraries by the part they play; the first name of each that is loaded counts.
PARTS = {
    "linear solver": (("dmumps_seq", "MUMPS"), ("dmumps", "MUMPS"), ("coinmumps", "MUMPS")),
    "BLAS": (("openblas", "OpenBLAS"), ("blas", "reference BLAS"), ("mkl_rt", "MKL")),
    "OpenMP": (("gomp", "GNU libgomp"), ("omp", "LLVM libomp")),
}


def version() -> None:
    """Print the version, and what is inside and loaded.

    Example: mcplan version
    """
    from mcplan._core import __version__, compiled_with, nlp

    print(__version__)
    print(f"Ipopt {nlp.ipopt_version()}")
    loaded = _loaded()
    for part, names in PARTS.items():
        print(f"{part}: {_used(names, loaded) if loaded else 'not known, since /proc cannot be read'}")
    for name, value in compiled_with().items():
        print(f"{name}: {value}")


def _loaded() -> list[Path]:
    """The shared libraries of this process; none where the system does not tell."""
    try:
        text = Path("/proc/self/maps").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return []
    return sorted({Path(found) for found in re.findall(r"(?m) (/\S+\.so[\d.]*)$", text)})


def _used(names: tuple[tuple[str, str], ...], loaded: list[Path]) -> str:
    """The first of the libraries that is loaded: the wheel's own before those that other packages have brought."""
    for stem, title in names:
        found = [path for path in loaded if re.match(rf"lib{stem}(?![a-z_])", path.name)]
        found.sort(key=lambda path: path.parent.name != "mcplan.libs")
        if found:
            where = "in the wheel" if found[0].parent.name == "mcplan.libs" else "of the system"
            return f"{title} ({found[0].name}, {where})"
    return "none found"
