"""The engines by which a shot is rendered. Each has `check()`, which raises Refused if the engine is not there, and `work(job, frames, logs)`.

`work` is a generator that yields a sentence from time to time while tasks are running, and ends when none is any more; closed before, it stops them.
"""

import itertools
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import pinned

TASK = Path(__file__).with_name("render.sh")
PAUSE = 0.5
"""Seconds between two looks at how far a task is."""


class Refused(Exception):
    """Something cannot be done, for the reason that the sentence says."""


class Job(NamedTuple):
    """What all tasks of a shot have in common."""

    name: str
    folder: Path  # for what the engine needs, and for logs
    blender: str  # the command, quoted for a shell
    file: Path
    output: Path  # pattern of the pictures' names, with #### for the frame
    format: str = ""  # of the pictures; empty: the scene's own
    zip: str = ""  # Motus, which each task installs; empty: the file needs none

    def arguments(self, logs):
        """Arguments of render.sh, without the frame. logs: folder."""
        return (self.blender, str(self.file), str(self.output), self.format, str(logs), self.zip)

    def plain_command(self):
        """The command that renders a frame, with FRAME in place of its number."""
        form = ["--render-format", self.format] if self.format else []
        options = ["--render-output", str(self.output), *form, "--use-extension", "1", "--render-frame", "FRAME"]
        return f"{self.blender.strip()} --background --enable-autoexec {shlex.join([str(self.file), *options])}"


def log_of(logs, frame):
    """The file in which a task writes what Blender says, as render.sh names it."""
    return logs / f"frame_{'-' * (frame < 0)}{abs(frame):04d}.log"


def _watched(command, said):
    """Run a command, with its output in the file `said`: a generator that ends with it; closed before, it ends the command."""
    options = {"stdin": subprocess.DEVNULL, "stderr": subprocess.STDOUT, "start_new_session": True}
    with open(said, "wb") as output, subprocess.Popen(command, stdout=output, **options) as process:
        try:
            while process.poll() is None:
                yield ""
                time.sleep(PAUSE)
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGTERM)  # the Blender that it has started as well


def _asked(*command):
    """What a command of an engine says. Raises Refused with its last line if it fails."""
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode:
        raise Refused(f"{command[0]} failed: {_last_line(done.stderr) or _last_line(done.stdout) or done.returncode}")
    return done.stdout.strip()


def _last_line(text):
    return next((line.strip() for line in reversed(text.splitlines()) if line.strip()), "")


class Local:
    """This machine, one process after another."""

    def check(self):
        pass

    def work(self, job, frames, logs):
        for frame in frames:
            yield from _watched(("bash", TASK, *job.arguments(logs), str(frame)), job.folder / "local.log")


class OpenJd:
    """The openjd of PyPI, which runs an Open Job Description template on this machine.

    programs: folder in which Motus keeps programs of PyPI.
    """

    def __init__(self, programs):
        self._programs = programs

    def check(self):
        folder, why_not = pinned.installed("openjd", self._programs.resolve())
        if not folder:
            raise Refused(f"openjd could not be installed by pip: {why_not}")
        self._program = folder / "openjd"

    def work(self, job, frames, logs):
        template, parameters, tasks = (job.folder / name for name in ("template.json", "parameters.json", "tasks.json"))
        template.write_text(json.dumps(_template(job.name), indent=2), encoding="utf-8")
        names = ("Blender", "File", "Output", "Format", "Logs", "Zip")
        values = dict(zip(names, job.arguments(logs))) | {"Folder": str(job.folder), "Frames": ranges(frames)}
        values["Out"], values["Pictures"] = str(job.output.parent), job.output.name
        del values["Output"]
        parameters.write_text(json.dumps(values, indent=2), encoding="utf-8")
        said = job.folder / "openjd.log"
        left = list(frames)
        while left:  # openjd ends with the first task that fails
            tasks.write_text(json.dumps([{"Frame": str(frame)} for frame in left]), encoding="utf-8")
            command = (
                self._program,
                "run",
                template,
                "--step",
                "Render",
                "--job-param",
                f"file://{parameters}",
                "--tasks",
                f"file://{tasks}",
            )
            yield from _watched(command, said)
            begun = [frame for frame in left if log_of(logs, frame).exists()]
            if not begun:
                raise Refused(f"openjd has run no task, see {said}: {_last_line(said.read_text(errors='replace'))}")
            left = [frame for frame in left if frame not in begun]


def _template(name):
    """The job as an Open Job Description template: a task a frame."""
    folder = {"type": "PATH", "objectType": "DIRECTORY"}
    return {
        "specificationVersion": "jobtemplate-2023-09",
        "name": name[:128],
        "parameterDefinitions": [
            {"name": "Blender", "type": "STRING", "default": "blender", "description": "Command of Blender on the workers"},
            {"name": "File", "type": "PATH", "objectType": "FILE", "dataFlow": "IN", "description": "The shot"},
            {"name": "Folder", **folder, "dataFlow": "IN", "description": "Folder of the job, in which caches of the shot and Motus are"},
            {"name": "Out", **folder, "dataFlow": "OUT", "description": "Folder for the pictures"},
            {"name": "Pictures", "type": "STRING", "description": "Pattern of the pictures' names, with #### for the frame"},
            {"name": "Format", "type": "STRING", "default": "", "description": "Format of the pictures; empty: the scene's own"},
            {"name": "Logs", "type": "STRING", "default": "", "description": "Folder for what Blender says; empty: the session's log"},
            {"name": "Zip", "type": "STRING", "default": "", "description": "Motus, for a shot that needs it"},
            {"name": "Frames", "type": "STRING", "description": "Such as 1-250"},
        ],
        "steps": [
            {
                "name": "Render",
                "parameterSpace": {"taskParameterDefinitions": [{"name": "Frame", "type": "INT", "range": "{{Param.Frames}}"}]},
                "script": {
                    "actions": {
                        "onRun": {
                            "command": "bash",
                            "args": [
                                "{{Task.File.Render}}",
                                "{{Param.Blender}}",
                                "{{Param.File}}",
                                "{{Param.Out}}/{{Param.Pictures}}",
                                "{{Param.Format}}",
                                "{{Param.Logs}}",
                                "{{Param.Zip}}",
                                "{{Task.Param.Frame}}",
                            ],
                        }
                    },
                    "embeddedFiles": [{"name": "Render", "type": "TEXT", "data": TASK.read_text(encoding="utf-8")}],
                },
            }
        ],
    }


def ranges(frames):
    """Rising frames as text: 1-3,7."""
    runs = [[frame for _, frame in run] for _, run in itertools.groupby(enumerate(frames), lambda pair: pair[1] - pair[0])]
    return ",".join(f"{run[0]}-{run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs)


class Slurm:
    """A Slurm cluster: array jobs of a task a frame. Folders of the shot and of the pictures have the same path on all nodes."""

    PAUSE = 2.0
    PATIENCE = 60
    """Looks in a row without an answer, after which the controller counts as gone."""

    def check(self):
        for program in ("sbatch", "squeue", "scancel", "scontrol"):
            if not shutil.which(program):
                raise Refused(f"Slurm is not here: there is no program {program}, which is in Debian's package slurm-client")
        try:
            self._most = int(re.search(r"MaxArraySize\s*=\s*(\d+)", _asked("scontrol", "show", "config"))[1])
        except Refused as refusal:
            raise Refused(f"Slurm does not answer: {refusal}") from None

    def work(self, job, frames, logs):
        task = job.folder / TASK.name
        shutil.copy(TASK, task)
        numbers = []
        try:
            parts = (frames[first : first + self._most] for first in range(0, len(frames), self._most))
            numbers.extend(self._submitted(job, part, task, logs) for part in parts)
            yield f"Slurm has taken the shot as job {', '.join(numbers)}"
            yield from self._watched(numbers)
        finally:
            for number in numbers:
                subprocess.run(("scancel", "--quiet", number), check=False, capture_output=True)

    @staticmethod
    def _submitted(job, frames, task, logs):
        script = job.folder / "array.sh"
        script.write_text(
            f"#!/usr/bin/env bash\nframes=({' '.join(map(str, frames))})\n"
            f'exec bash {shlex.join((str(task), *job.arguments(logs)))} "${{frames[$SLURM_ARRAY_TASK_ID]}}"\n',
            encoding="utf-8",
        )
        # A task is queued again if its node dies.
        options = (
            f"--array=0-{len(frames) - 1}",
            "--requeue",
            f"--chdir={job.folder}",
            "--output=/dev/null",
            f"--job-name=motus {job.name}",
        )
        return _asked("sbatch", "--parsable", *options, str(script)).partition(";")[0]

    def _watched(self, numbers):
        silent = 0
        while True:
            time.sleep(self.PAUSE)
            command = ("squeue", "--noheader", "--array", "--jobs", ",".join(numbers), "--format", "%T %r")
            done = subprocess.run(command, check=False, capture_output=True, text=True)
            if done.returncode and "Invalid job id" in done.stderr:
                return  # Slurm forgets jobs some minutes after their end
            silent = silent + 1 if done.returncode else 0
            if silent > self.PATIENCE:
                raise Refused(f"Slurm does not answer any more: {_last_line(done.stderr)}")
            # Slurm holds a task that it could not start on a node; the next try submits it anew.
            waiting = [line for line in done.stdout.splitlines() if "held" not in line.lower()]
            if not done.returncode and not waiting:
                return
            yield ""


ENGINES = ("slurm", "openjd", "local")


def engine(name, programs):
    """The engine of a name in ENGINES."""
    return {"slurm": Slurm, "local": Local}[name]() if name != "openjd" else OpenJd(programs)
