"""clang-tidy over the library and the bindings: tidy.py BUILD_FOLDER

The bindings are compiled once for each Python; they are checked with this machine's alone, whose headers clang can read.
"""

import json
import subprocess
import sys
from pathlib import Path

FOLDERS = ("native/src", "native/bindings")
CLONE = Path(__file__).resolve().parents[1]


def main(build):
    entries = json.loads(Path(build, "release", "compile_commands.json").read_text(encoding="utf-8"))
    entries = [entry for entry in entries if "motus_native_cp" not in entry["command"]]
    database = Path(build, "tidy", "compile_commands.json")
    database.parent.mkdir(exist_ok=True)
    database.write_text(json.dumps(entries), encoding="utf-8")
    files = [entry["file"] for entry in entries
             if any(Path(entry["file"]).is_relative_to(CLONE / folder) for folder in FOLDERS)]
    return subprocess.run(["run-clang-tidy", "-quiet", "-j", "2", "-p", str(database.parent), *files], check=False).returncode


sys.exit(main(*sys.argv[1:]))
