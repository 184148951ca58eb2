"""Puts the manual's figures that move into a site's folder."""

import base64
import gzip
import shutil
from pathlib import Path

SOURCES = Path(__file__).with_name("figures")


def copy(module, folder):
    """Copies the figures into `folder`, with the module motus.wasm packed into a script: pages that are opened from disk may load no other files.

    Without the module nothing is copied but a script that does nothing: the stills stay.
    """
    folder.mkdir(parents=True, exist_ok=True)
    if not module.exists():
        (folder / "figures.js").touch()
        return
    for source in sorted(SOURCES.iterdir()):
        shutil.copy(source, folder)
    text = base64.b64encode(gzip.compress(module.read_bytes(), 9, mtime=0)).decode()
    (folder / "motus.js").write_text(f'MotusFigures.module("{text}");\n', encoding="utf-8")
