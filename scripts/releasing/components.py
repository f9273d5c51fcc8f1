"""What is compiled into a wheel or copied into it, under which licence, and where Debian keeps the text of that."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Component:
    """One piece of third-party software.

    Attributes:
        name: As its authors call it.
        licence: SPDX expression.
        packages: Debian packages that carry it, the first one found counts; they differ between suites.
        libraries: Names of its shared libraries without version (``libipopt``); none for what is compiled in.
        texts: Files of scripts/releasing/texts that hold licences which Debian's copyright file does not print.
        source: Where its source can be had.
    """

    name: str
    licence: str
    packages: tuple[str, ...]
    libraries: tuple[str, ...] = ()
    texts: tuple[str, ...] = ()
    source: str = ""


GCC = "GPL-3.0-or-later WITH GCC-exception-3.1"
COMPONENTS = (
    Component(
        "Ipopt", "EPL-1.0", ("coinor-libipopt1v5",), ("libipopt",), ("EPL-1.0.txt",), "https://github.com/coin-or/Ipopt"
    ),
    Component(
        "MUMPS", "CECILL-C", ("libmumps-5.5",), ("libdmumps_seq", "libmumps_common_seq"), (), "https://mumps-solver.org"
    ),
    Component(
        "Scotch",
        "CECILL-C",
        ("libscotch-7.0",),
        ("libscotch", "libscotcherr", "libesmumps"),
        (),
        "https://gitlab.inria.fr/scotch/scotch",
    ),
    Component("BLAS", "BSD-3-Clause", ("libblas3",), ("libblas",), (), "https://netlib.org/lapack"),
    Component("LAPACK", "BSD-3-Clause", ("liblapack3",), ("liblapack",), (), "https://netlib.org/lapack"),
    Component("GCC runtime for Fortran", GCC, ("libgfortran5",), ("libgfortran",), (), "https://gcc.gnu.org"),
    Component("libquadmath", "LGPL-2.1-or-later", ("libquadmath0",), ("libquadmath",), (), "https://gcc.gnu.org"),
    Component("GCC runtime for OpenMP", GCC, ("libgomp1",), ("libgomp",), (), "https://gcc.gnu.org"),
    Component("bzip2", "bzip2-1.0.6", ("libbz2-1.0",), ("libbz2",), (), "https://sourceware.org/bzip2"),
    Component(
        "XZ Utils (liblzma)", "LicenseRef-public-domain", ("liblzma5",), ("liblzma",), (), "https://tukaani.org/xz"
    ),
    Component("Eigen", "MPL-2.0", ("libeigen3-dev",), (), (), "https://eigen.tuxfamily.org"),
    Component("toml++", "MIT", ("libtomlplusplus-dev",), (), (), "https://github.com/marzer/tomlplusplus"),
    Component("JSON for Modern C++", "MIT", ("nlohmann-json3-dev",), (), (), "https://github.com/nlohmann/json"),
    Component("LEMON", "BSL-1.0", ("liblemon-dev",), (), (), "https://lemon.cs.elte.hu"),
    Component("pybind11", "BSD-3-Clause", (), (), ("pybind11.txt",), "https://github.com/pybind/pybind11"),
)


class MissingNotice(Exception):
    """A library is copied into a wheel of which no component says the licence."""


def stem(library: str) -> str:
    """The name of a shared library without version and without the hash that auditwheel puts into it.

    >>> stem("libdmumps_seq-5-6a91c4c9.5.so"), stem("libz-1f2e3d4c.so.1.2.13"), stem("libblas.so.3")
    ('libdmumps_seq', 'libz', 'libblas')
    """
    return re.sub(r"(-[0-9]+(\.[0-9]+)*)?$", "", re.sub(r"(-[0-9a-f]{8})?(\.[0-9]+)*\.so.*$", "", library))


def components_of(libraries: list[str]) -> list[Component]:
    """The components of a wheel with these libraries: theirs, and all that are compiled in.

    Raises:
        MissingNotice: A library belongs to no component; the message names it.
    """
    known = {name: component for component in COMPONENTS for name in component.libraries}
    unknown = sorted(library for library in libraries if stem(library) not in known)
    if unknown:
        raise MissingNotice(f"no notice in scripts/releasing/components.py for {', '.join(unknown)}")
    found = {known[stem(library)].name for library in libraries}
    return [component for component in COMPONENTS if not component.libraries or component.name in found]
