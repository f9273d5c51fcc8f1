"""The software bill of materials of a wheel, as CycloneDX 1.6: what it carries, and what pip installs with it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from releasing.components import Component, components_of, stem

ROOT = Path(__file__).resolve().parents[2]


def licence(expression: str) -> list[dict[str, Any]]:
    """An SPDX expression as CycloneDX writes it."""
    return [{"expression": expression}]


def carried(component: Component, version: str, hashes: dict[str, str]) -> dict[str, Any]:
    """One component that is compiled in or copied, with the SHA-256 of its libraries in the wheel."""
    out: dict[str, Any] = {
        "type": "library",
        "bom-ref": f"carried:{component.name}",
        "name": component.name,
        "version": version,
        "licenses": licence(component.licence),
        "externalReferences": [{"type": "website", "url": component.source}],
    }
    files = sorted(name for name in hashes if stem(name) in component.libraries)
    if files:
        out["components"] = [
            {
                "type": "file",
                "bom-ref": f"file:{name}",
                "name": name,
                "hashes": [{"alg": "SHA-256", "content": hashes[name]}],
            }
            for name in files
        ]
    return out


def locked(names: list[str]) -> list[dict[str, Any]]:
    """What mcplan depends on, in the versions of requirements/dev.lock."""
    text = (ROOT / "requirements/dev.lock").read_text(encoding="utf-8")
    out = []
    for name in names:
        versions = sorted(set(re.findall(rf"(?m)^{re.escape(name)}==([^\s;\\]+)", text)))
        for version in versions:
            purl = f"pkg:pypi/{name}@{version}"
            out.append({"type": "library", "bom-ref": purl, "name": name, "version": version, "purl": purl})
    return out


def bill(version: str, hashes: dict[str, str], needs: list[str], versions: dict[str, str]) -> dict[str, Any]:
    """The bill of a wheel.

    Args:
        version: Of mcplan.
        hashes: SHA-256 of each bundled library, by its name in the wheel.
        needs: Names of the distributions that mcplan depends on.
        versions: Of each component, by name.
    """
    ref = f"pkg:pypi/mcplan@{version}"
    inside = [carried(each, versions[each.name], hashes) for each in components_of(list(hashes))]
    others = locked(needs)
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "component": {
                "type": "library",
                "bom-ref": ref,
                "name": "mcplan",
                "version": version,
                "purl": ref,
                "licenses": licence("BSD-3-Clause"),
            }
        },
        "components": inside + others,
        "dependencies": [{"ref": ref, "dependsOn": sorted({each["bom-ref"] for each in inside + others})}],
    }
