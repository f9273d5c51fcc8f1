"""scripts/docs --site: the whole documentation as a folder of HTML."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from pages.page import ROOT
from pages.site import gallery, local_links, reference, stage

#: What makes a site, and where it comes from.
NEEDED = {"sphinx": "pip install -e '.[docs]'", "doxygen": "apt-get install doxygen"}


def build(out: Path, fresh: bool = False, quick: bool = False) -> int:
    """Build the site.

    Args:
        out: Folder for the HTML; what was in it is removed.
        fresh: Run all notebooks and the commands of the gallery again.
        quick: Run neither: tutorials have no output, the gallery what has been made before.

    Returns:
        0, or 1 where something is missing, a warning was printed or a link leads nowhere.
    """
    try:
        import sphinx  # noqa: F401
    except ImportError:
        return _missing("sphinx")
    if shutil.which("doxygen") is None:
        return _missing("doxygen")
    work = ROOT / "build/site"
    source, kept, xml, cache = work / "source", work / "gallery", work / "doxygen", work / "notebooks"
    if fresh:
        shutil.rmtree(cache, ignore_errors=True)
    stage.stage(source)
    reference.run_doxygen(xml)
    reference.write_reference(source)
    gallery.write_gallery(source, kept, fresh, quick)
    told = {
        "MCPLAN_DOXYGEN_XML": str(xml),
        "MCPLAN_NOTEBOOK_CACHE": str(cache),
        "MCPLAN_NOTEBOOKS": "off" if quick else "cache",
    }
    shutil.rmtree(out, ignore_errors=True)
    words = [
        sys.executable,
        "-m",
        "sphinx",
        "-W",
        "--keep-going",
        "-q",
        "-d",
        str(work / "doctrees"),
        "-b",
        "html",
        str(source),
        str(out),
    ]
    code = subprocess.run(words, env=os.environ | told).returncode
    faults = local_links.faults(out) if code == 0 else []
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"wrote {out}/index.html" if code == 0 and not faults else "the site is not whole", flush=True)
    return int(code != 0 or bool(faults))


def _missing(name: str) -> int:
    print(f"error: the site needs {name}: {NEEDED[name]}", file=sys.stderr)
    return 1
