"""`./motus farm`: renders the frames of a shot by an existing engine, a task a frame, and goes on until each has a whole picture or has failed often.

Exit status: 0 if all pictures are there, 1 if frames failed or the engine did, 2 if something that was given is wrong.
"""

import argparse
import json
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import engines
from engines import Job, Refused, log_of

HERE = Path(__file__).resolve().parent
MOTUS = HERE.parents[1] / "motus"
MARK = "MOTUS-FARM "
OUTERMOST = 1048574
"""Largest number of a frame in Blender, and the smallest with its sign changed."""
AGAIN = 15.0
"""Seconds after which progress is told again, though nothing has changed."""


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"motus: farm: {message} (./motus help tells how it is used)\n")


def arguments(words):
    """What the command line says. Raises Refused if that cannot be done."""
    parser = _Parser(prog="motus farm", add_help=False)
    parser.add_argument("shot", type=Path, metavar="SHOT.blend")
    parser.add_argument("--frames", required=True)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--with", required=True, dest="engine", choices=engines.ENGINES)
    parser.add_argument("--live", action="store_true")
    parser.add_argument("--blender", default="")
    parser.add_argument("--tries", type=int, default=3)
    parser.add_argument("--programs", type=Path, required=True)
    given = parser.parse_args(words)
    given.frames = frames_of(given.frames)
    given.shot, given.out = given.shot.resolve(), given.out.resolve()
    if not given.shot.is_file():
        raise Refused(f"there is no file {given.shot}")
    if given.tries < 1:
        raise Refused(f"--tries is how often a frame is begun at most, so it is at least 1, and not {given.tries}")
    return given


def frames_of(text):
    """Rising numbers of frames: of 7, 1-250 or 1-3,7. Raises Refused if the text is no such thing."""
    found = set()
    for part in text.split(","):
        match = re.fullmatch(r"\s*(-?\d+)(?:-(-?\d+))?\s*", part)
        if not match:
            raise Refused(f"--frames wants numbers such as 1-250 or 1-3,7, and not {text!r}")
        first, last = int(match[1]), int(match[2] or match[1])
        if last < first:
            raise Refused(f"--frames {part.strip()} ends before it begins")
        if max(abs(first), abs(last)) > OUTERMOST:
            raise Refused(f"--frames {part.strip()} goes beyond frame {OUTERMOST}, which is Blender's last")
        found.update(range(first, last + 1))
    return sorted(found)


def check_writable(folder):
    """Make a folder for pictures. Raises Refused if nothing can be written there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise Refused(f"nothing can be written into {folder}: {error.strerror}") from None


def motus(command, *words):
    """What an internal command of ./motus prints. If it fails this process ends too, since the command has said why."""
    done = subprocess.run((MOTUS, command, *words), check=False, stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(1)
    return done.stdout.strip()


def look(blender, file, output, frames):
    """What look.py says of a file and its pictures. blender: command, quoted for a shell."""
    asked = json.dumps({"output": str(output), "frames": frames})
    command = (
        *shlex.split(blender),
        "--background",
        "--disable-autoexec",
        file,
        "--python-exit-code",
        "1",
        "--python",
        HERE / "look.py",
        "--",
        asked,
    )
    done = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    answer = next((line for line in done.stdout.splitlines() if line.startswith(MARK)), None)
    if answer is None:
        lines = [line for line in done.stdout.splitlines() if line.strip()]
        raise Refused(f"Blender cannot open {file}: {lines[-1] if lines else done.returncode}")
    answer = json.loads(answer.removeprefix(MARK))
    answer["pictures"] = {int(frame): [Path(path) for path in paths] for frame, paths in answer["pictures"].items()}
    return answer


class Progress:
    """Says how many frames are done, when that has changed or a while has passed."""

    def __init__(self, pictures, is_done):
        self._pictures, self._done, self._said, self._time = pictures, is_done, None, 0.0

    def show(self):
        """Print a line, if it is time."""
        count = sum(frame in self._done or all(path.exists() for path in paths) for frame, paths in self._pictures.items())
        if count != self._said or time.monotonic() > self._time + AGAIN:
            say(f"{count} of {len(self._pictures)} frames")
            self._said, self._time = count, time.monotonic()


def say(text):
    """Print a line for the user."""
    print(f"motus: {text}", file=sys.stderr, flush=True)


def prepared(given, facts, blender, folder, output):
    """The Job: the shot handed over, or with the zip of Motus, unless nothing in it needs Motus."""
    common = {"name": given.shot.stem, "folder": folder, "blender": blender, "output": output, "format": facts["format"]}
    if not facts["has_motus"]:
        return Job(file=given.shot, **common)
    if given.live:
        own = shutil.copy(motus("farm_zip", given.blender), folder)
        return Job(file=given.shot, zip=str(own), **common)
    first, last = given.frames[0], max(given.frames[-1], given.frames[0] + 1)  # one frame alone is not handed over
    say("the shot is handed over, so that it plays without Motus")
    result = folder / f"{given.shot.stem}.blend"
    result.unlink(missing_ok=True)
    log = folder / "hand_over.log"
    with open(log, "wb") as said:
        command = (MOTUS, "farm_hand_over", given.blender, given.shot, result, str(first), str(last))
        subprocess.run(command, check=False, stdout=said, stderr=subprocess.STDOUT)
    if not result.is_file():
        lines = [line for line in log.read_text(errors="replace").splitlines() if line.startswith("motus: ")]
        reason = lines[-1].removeprefix("motus: ") if lines else "Blender says no reason"
        raise Refused(f"the shot cannot be handed over, see {log}: {reason} (--live renders it with Motus on the workers)")
    return Job(file=result, **common)


def render(given, engine):
    """Renders what is missing; returns the exit status."""
    blender = motus("farm_blender", given.blender)
    output = given.out / (re.sub(r"[#{}]", "_", given.shot.stem) + "_####")
    folder = given.out / "farm"
    facts = look(blender, given.shot, output, given.frames)
    left = [frame for frame in given.frames if frame not in facts["whole"]]
    if len(left) < len(given.frames):
        say(f"{len(given.frames) - len(left)} of {len(given.frames)} frames are done already")
    if not left:
        return 0
    shutil.rmtree(folder / "logs", ignore_errors=True)
    folder.mkdir(exist_ok=True)
    job = prepared(given, facts, blender, folder, output)
    say(f"a frame is rendered by: {job.plain_command()}")
    began = time.monotonic()
    for attempt in range(1, given.tries + 1):
        logs = folder / "logs" / f"try_{attempt}"
        logs.mkdir(parents=True)
        for frame in left:
            for path in facts["pictures"][frame]:
                path.unlink(missing_ok=True)  # it cannot be read
        for path in given.out.glob(".motus-*"):
            shutil.rmtree(path, ignore_errors=True)  # of a task that was killed
        progress = Progress(facts["pictures"], set(given.frames) - set(left))
        for sentence in engine.work(job, left, logs):
            if sentence:
                say(sentence)
            progress.show()
        whole = look(blender, job.file, output, left)["whole"]
        left = [frame for frame in left if frame not in whole]
        if not left:
            say(f"all {len(given.frames)} frames are in {given.out}, after {time.monotonic() - began:.0f} s of the engine")
            return 0
        say(f"{len(left)} frames have no whole picture after try {attempt} of {given.tries}: {engines.ranges(left)}")
    for frame in left:
        say(f"frame {frame} failed, see {log_of(logs, frame)}")
    return 1


def main(words):
    """Returns the exit status."""
    try:
        given = arguments(words)
        engine = engines.engine(given.engine, given.programs)
        engine.check()
        check_writable(given.out)
    except Refused as refusal:
        say(f"farm: {refusal}")
        return 2
    try:
        return render(given, engine)
    except Refused as refusal:
        say(f"farm: {refusal}")
        return 1
    except KeyboardInterrupt:
        say("farm: broken off; what is done stays, and the same command goes on from there")
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
