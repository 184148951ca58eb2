"""A Slurm cluster of one machine: a controller and two nodes with one processor each, in a temporary folder, with ports and a key of their own."""

import getpass
import os
import shutil
import socket
import subprocess
import tempfile
import time
from pathlib import Path

NEEDED = ("munged", "slurmctld", "slurmd", "sinfo", "sbatch")
NODES = ("n1", "n2")
PATIENCE = 60.0
"""Seconds within which all nodes have to be up."""
_SETTINGS = """
ClusterName=motus
SlurmctldHost={host}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/controller.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/controller.log
SlurmdLogFile={folder}/%n.log
SlurmctldPort={controller}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
ReturnToService=2
SlurmdTimeout=10
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,batch_sched_delay=1
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
"""


def missing():
    """The programs that a cluster lacks here."""
    os.environ["PATH"] += ":/usr/sbin"
    return [name for name in NEEDED if not shutil.which(name)]


def _free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    try:
        for one in sockets:
            one.bind(("", 0))
        return [one.getsockname()[1] for one in sockets]
    finally:
        for one in sockets:
            one.close()


class Cluster:
    """A cluster that is up; `stop` ends it. `environment` has what commands of Slurm need to find it."""

    def __init__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="motus-slurm-"))
        self.folder.chmod(0o755)  # munged wants its socket to be found by all
        self._processes = {}
        try:
            self._start()
        except BaseException:
            self.stop()
            raise

    def _start(self):
        controller, *ports = _free_ports(1 + len(NODES))
        host = socket.gethostname().partition(".")[0]
        text = _SETTINGS.format(host=host, folder=self.folder, user=getpass.getuser(), controller=controller)
        nodes = [f"NodeName={name} NodeHostname={host} Port={port} CPUs=1 State=UNKNOWN" for name, port in zip(NODES, ports)]
        settings = self.folder / "slurm.conf"
        settings.write_text(
            "\n".join((text, *nodes, f"PartitionName=main Nodes={','.join(NODES)} Default=YES MaxTime=INFINITE State=UP", "")),
            encoding="utf-8",
        )
        (self.folder / "state").mkdir()
        for name in NODES:
            (self.folder / f"spool-{name}").mkdir()
        self.environment = os.environ | {"SLURM_CONF": str(settings)}
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        places = {"key-file": key, "socket": "munge.socket", "pid-file": "munge.pid", "log-file": "munge.log", "seed-file": "munge.seed"}
        self._run("munged", "--foreground", *(f"--{name}={self.folder / place}" for name, place in places.items()))
        self._wait((self.folder / "munge.socket").exists, "munged has no socket")
        self._run("slurmctld", "-D", "-f", settings)
        for name in NODES:
            self._run(name, "-D", "-N", name, "-f", settings, program="slurmd")
        self._wait(self._is_up, "not all nodes are up")

    def _run(self, name, *arguments, program=None):
        with open(self.folder / f"{name}.out", "wb") as said:
            # Sessions of their own, so that a node ends with all that it runs.
            self._processes[name] = subprocess.Popen(
                (program or name, *arguments),
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=said,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def _is_up(self):
        done = subprocess.run(
            ("sinfo", "--noheader", "--Node", "--format", "%T"), check=False, env=self.environment, capture_output=True, text=True
        )
        return done.stdout.split() == ["idle"] * len(NODES)

    def _wait(self, is_so, otherwise):
        end = time.monotonic() + PATIENCE
        while not is_so():
            if time.monotonic() > end:
                said = "\n".join(f"{path.name}: {path.read_text(errors='replace')[-600:]}" for path in self.folder.glob("*.[lo][ou][gt]"))
                raise RuntimeError(f"{otherwise}\n{said}")
            time.sleep(0.3)

    def kill(self, name):
        """Kill a node, with the task that it is running, as a loss of power does."""
        victims = [self._processes[name].pid, *self._tasks_of(name)]
        for pid in victims:
            subprocess.run(("kill", "-KILL", str(pid)), check=False, stderr=subprocess.DEVNULL)
        self._processes.pop(name).wait()

    def _tasks_of(self, name):
        """Processes that have been started by a node: Slurm tells each of them which one."""
        for path in Path("/proc").glob("[0-9]*/environ"):
            try:
                words = path.read_bytes().split(b"\0")
            except OSError:
                continue  # it has ended
            if f"SLURMD_NODENAME={name}".encode() in words and f"SLURM_CONF={self.environment['SLURM_CONF']}".encode() in words:
                yield int(path.parent.name)

    def stop(self):
        """End all that has been started, and remove the folder."""
        for name in NODES:
            if name in self._processes:
                self.kill(name)
        for process in self._processes.values():
            process.terminate()
        for process in self._processes.values():
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
