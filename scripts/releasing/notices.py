"""The notices of what a wheel carries: the texts that the Debian packages state, and those that they only refer to."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from releasing.components import Component, MissingNotice, components_of

TEXTS = Path(__file__).with_name("texts")
DOCUMENTS = Path("/usr/share/doc")
COMMON = Path("/usr/share/common-licenses")


def package_of(component: Component) -> str:
    """The Debian package that is installed of those that carry a component, empty for what comes from PyPI."""
    for package in component.packages:
        if (DOCUMENTS / package / "copyright").exists():
            return package
    if component.packages:
        raise MissingNotice(f"{component.name}: none of {', '.join(component.packages)} is installed")
    return ""


def version_of(component: Component) -> str:
    """The version of the package that carries a component, as Debian or PyPI writes it."""
    package = package_of(component)
    if package:
        shown = subprocess.run(
            ["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True, check=True
        )
        return shown.stdout
    from importlib.metadata import version

    return version(component.name)


def notice(component: Component) -> tuple[str, set[str]]:
    """The text for one component, and the names of Debian's common licences that it refers to."""
    parts = [f"{component.name} {version_of(component)}\nLicence: {component.licence}\nSource: {component.source}\n"]
    package = package_of(component)
    if package:
        text = (DOCUMENTS / package / "copyright").read_text(encoding="utf-8", errors="replace")
        parts.append(f"Debian's copyright file of {package}:\n\n{text}")
    parts += [(TEXTS / name).read_text(encoding="utf-8") for name in component.texts]
    text = "\n\n".join(parts)
    return text, set(re.findall(r"common-licenses/([A-Za-z]+(?:-[0-9]+(?:\.[0-9]+)?)?)", text))


def notices(libraries: list[str]) -> dict[str, str]:
    """The files of notices for a wheel with these libraries, by name.

    Raises:
        MissingNotice: A library has no component, or a component no text.
    """
    out: dict[str, str] = {}
    common: set[str] = set()
    for component in components_of(libraries):
        text, referred = notice(component)
        out[re.sub(r"\W+", "_", component.name).strip("_") + ".txt"] = text
        common |= referred
    for name in sorted(common):
        if (COMMON / name).exists():
            out[f"common/{name}.txt"] = (COMMON / name).read_text(encoding="utf-8")
    return out
