"""Puts the manual's figures that move into a site's folder."""

import base64
import shutil
from pathlib import Path

SOURCES = Path(__file__).with_name("figures")


def copy(module, folder):
    """Copies the figures into `folder`, with the module motus.wasm as a script: pages that are opened from disk may load no other files."""
    folder.mkdir(parents=True, exist_ok=True)
    for source in sorted(SOURCES.iterdir()):
        shutil.copy(source, folder)
    text = base64.b64encode(module.read_bytes()).decode()
    (folder / "motus.js").write_text(f'MotusFigures.module("{text}");\n', encoding="utf-8")
