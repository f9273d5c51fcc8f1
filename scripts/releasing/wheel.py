"""Finish a wheel that auditwheel has repaired: add the notices and the bill of materials, then check what it holds.

    python -m releasing.wheel WHEEL

The wheel is rewritten in place, the same bytes for the same contents. The exit code is 1, with a line for each fault, when
a library has no notice, a symbol other than PyInit__core is exported, or the wheel is larger than 15 MB.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from releasing import notices, sbom
from releasing.components import MissingNotice, components_of

MAX_BYTES = 15_000_000


def libraries(files: dict[str, bytes]) -> dict[str, str]:
    """The SHA-256 of each library that auditwheel has copied, by its name."""
    return {
        Path(name).name: hashlib.sha256(data).hexdigest()
        for name, data in files.items()
        if name.startswith("mcplan.libs/")
    }


def needs(files: dict[str, bytes], info: str) -> list[str]:
    """The names of the distributions that the metadata ask for without an extra."""
    lines = re.findall(r"(?m)^Requires-Dist: ([\w.-]+)(.*)$", files[f"{info}/METADATA"].decode())
    return [name for name, rest in lines if "extra ==" not in rest]


def record(files: dict[str, bytes], info: str) -> bytes:
    """The list of files with their hashes that a wheel ends with."""
    rows = []
    for name in sorted(files):
        digest = base64.urlsafe_b64encode(hashlib.sha256(files[name]).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(files[name])}")
    return "\n".join([*rows, f"{info}/RECORD,,", ""]).encode()


def finish(path: Path) -> None:
    """Add notices and bill of materials to a wheel."""
    with zipfile.ZipFile(path) as old:
        modes = {entry.filename: entry.external_attr for entry in old.infolist()}
        files = {entry.filename: old.read(entry) for entry in old.infolist() if not entry.is_dir()}
    (info,) = {name.split("/")[0] for name in files if name.split("/")[0].endswith(".dist-info")}
    hashes = libraries(files)
    for name, text in notices.notices(list(hashes)).items():
        files[f"{info}/licenses/third_party/{name}"] = text.encode()
    versions = {each.name: notices.version_of(each) for each in components_of(list(hashes))}
    content = sbom.bill(path.name.split("-")[1], hashes, needs(files, info), versions)
    files[f"{info}/sboms/mcplan.cdx.json"] = (json.dumps(content, indent=1) + "\n").encode()
    del files[f"{info}/RECORD"]
    files[f"{info}/RECORD"] = record(files, info)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as new:
        for name in sorted(files, key=lambda each: (each.endswith("/RECORD"), each)):
            entry = zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0))
            entry.external_attr = modes.get(name, 0o644 << 16)
            entry.compress_type = zipfile.ZIP_DEFLATED
            new.writestr(entry, files[name])


def exported(library: Path) -> list[str]:
    """The symbols that a shared library defines for others."""
    shown = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)
    return [line.split()[-1] for line in shown.stdout.splitlines()]


def faults(path: Path) -> list[str]:
    """What is wrong with a finished wheel."""
    out = []
    if path.stat().st_size > MAX_BYTES:
        out.append(f"{path.name}: {path.stat().st_size / 1e6:.1f} MB, at most {MAX_BYTES / 1e6:.0f} MB")
    with zipfile.ZipFile(path) as wheel, tempfile.TemporaryDirectory() as folder:
        names = wheel.namelist()
        (core,) = (name for name in names if re.fullmatch(r"mcplan/_core\.[^/]+\.so", name))
        others = [name for name in exported(Path(wheel.extract(core, folder))) if name != "PyInit__core"]
    if others:
        out.append(f"{path.name}: {core} exports {len(others)} symbols beside PyInit__core, {others[0]} first")
    held = {Path(name).name for name in names if "/licenses/third_party/" in name}
    for component in components_of([Path(name).name for name in names if name.startswith("mcplan.libs/")]):
        if re.sub(r"\W+", "_", component.name).strip("_") + ".txt" not in held:
            out.append(f"{path.name}: no notice for {component.name}")
    return out


def main(arguments: list[str]) -> int:
    if len(arguments) != 1 or arguments[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if arguments in (["-h"], ["--help"]) else 2
    path = Path(arguments[0])
    try:
        finish(path)
        found = faults(path)
    except MissingNotice as error:
        found = [str(error)]
    for fault in found:
        print(f"error: {fault}", file=sys.stderr)
    if not found:
        print(f"{path.name}: {path.stat().st_size / 1e6:.1f} MB, notices and bill of materials inside")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
