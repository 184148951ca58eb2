"""What is fetched once into a folder that clones share, whole or not at all."""

import fcntl
import shutil
import subprocess
import sys
import tempfile


def run(*command):
    """The last line of what went wrong, or nothing."""
    try:
        done = subprocess.run(command, check=False, capture_output=True, text=True)
    except OSError as error:
        return str(error)
    if not done.returncode:
        return ""
    said = (done.stderr.strip() or done.stdout.strip() or "no reason was given").splitlines()
    pips = [line for line in said if line.startswith("ERROR")]
    mavens = [line for line in said if line.startswith("[ERROR]")]
    return (pips[-1:] or mavens[:1] or said[-1:])[0]


def pip_install(folder, *arguments):
    """Has a fresh pip install with these arguments, all that it is given with its checksum; what run() returns."""
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix="pip-") as programs:
        install = ("install", "--quiet", "--no-cache-dir", "--no-compile", "--no-deps", "--only-binary=:all:", "--require-hashes")
        return run(sys.executable, "-m", "venv", programs) or run(f"{programs}/bin/pip", *install, *arguments, "--target", folder)


def fetched(place, what, fill):
    """(place, ""), a folder that `fill` has filled, which is given it and returns why it could not; or (None, why it cannot be had).

    what: said when it is fetched. What was broken off is fetched anew.
    """
    if (place / "complete").exists():
        return place, ""  # without waiting for what another clone fetches beside it
    place.parent.mkdir(parents=True, exist_ok=True)
    with open(place.parent / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # another clone may be fetching the same
        if not (place / "complete").exists():
            print(f"motus: {what}", file=sys.stderr)
            shutil.rmtree(place, ignore_errors=True)
            if why_not := fill(place):
                shutil.rmtree(place, ignore_errors=True)
                return None, why_not
            (place / "complete").touch()
    return place, ""
