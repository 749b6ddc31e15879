#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A Slurm cluster of its own on this machine, for tests: munged, slurmctld and a slurmd for each node, all on 127.0.0.1.

  local_slurm.py FOLDER [--nodes 2] [--cpus 2] -- COMMAND...     runs COMMAND with SLURM_CONF set; its exit code is the answer

Needs the Debian packages munge, slurmctld, slurmd, slurm-client, and a network interface besides lo (Slurm looks names up with
AI_ADDRCONFIG); no systemd, no cgroups, no root, nothing in /etc, /var or /run.
Everything is in FOLDER (made if it is not there; an earlier cluster's files in it are replaced), the daemons run as who starts
them, and are gone with the `with` block, whatever ended it; also when this process is killed, but for tasks then running."""
import argparse
import contextlib
import dataclasses
import fcntl
import os
import pathlib
import pwd
import random
import re
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import time

# munged and Slurm live in /usr/sbin, which is not in everyone's PATH.
PATH = os.pathsep.join((os.environ.get("PATH", os.defpath), "/usr/local/sbin", "/usr/sbin", "/sbin"))
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scontrol", "scancel", "setpriv")
ENDED = ("BOOT_FAIL", "CANCELLED", "COMPLETED", "DEADLINE", "FAILED", "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "TIMEOUT")
LONGEST_SOCKET = 107  # bytes that sun_path holds, less its end

CONF = """\
ClusterName=local
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller_port}
{listen}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
# A requeued job waits for cred_expire; 120 s if not said.
AuthInfo=socket={folder}/munge.socket,cred_expire={requeue_s}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
MailProg=/bin/true
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
# As many processors and as much memory as the nodes say, whatever the machine has.
SlurmdParameters=config_overrides
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=2,bf_interval=2
JobRequeue=1
ReturnToService=2
SlurmdTimeout={down_after_s}
MessageTimeout=5
KillWait={kill_wait_s}
# No accounting: what has ended is told as long as this by squeue and scontrol.
MinJobAge=86400
MaxArraySize={max_array_size}
"""


class SlurmError(RuntimeError):
    """What the cluster did not do, with the ends of its logs."""


@dataclasses.dataclass(frozen=True)
class Job:
    id: str  # 12, or 12_3 for task 3 of array 12
    array: int  # 12: what sbatch told
    task: int | None
    state: str  # PENDING, RUNNING, COMPLETED, FAILED, ...
    exit_code: int  # 128 + signal if one ended it
    node: str
    reason: str
    restarts: int
    name: str

    @property
    def ended(self):
        return self.state in ENDED


def missing_programs():
    """Those of PROGRAMS that are not installed."""
    return [program for program in PROGRAMS if not shutil.which(program, path=PATH)]


def free_ports(count):
    """Ports of 127.0.0.1 that nobody listens on, below those that the system gives to outgoing connections."""
    found = []
    for port in random.SystemRandom().sample(range(10000, 32000), 500):
        with socket.socket() as tried:
            try:
                tried.bind(("127.0.0.1", port))
            except OSError:
                continue
        found.append(port)
        if len(found) == count:
            return found
    raise SlurmError(f"no {count} free ports between 10000 and 32000")


def listening():
    """A line of slurm.conf. Slurm listens everywhere (munge keeps strangers out), or where the machine's own name leads."""
    with contextlib.suppress(OSError):
        if socket.gethostbyname(socket.gethostname()) == "127.0.0.1":
            return "CommunicationParameters=NoCtldInAddrAny,NoInAddrAny"
    return "# this machine's name does not lead to 127.0.0.1: no CommunicationParameters=NoCtldInAddrAny,NoInAddrAny"


def processes():
    """{pid: parent's pid} of all that runs."""
    found = {}
    for entry in os.scandir("/proc"):
        if entry.name.isdigit():
            with contextlib.suppress(OSError):  # it ended meanwhile
                fields = pathlib.Path(entry.path, "stat").read_text(errors="replace").rsplit(")", 1)[1].split()
                if fields[0] != "Z":
                    found[int(entry.name)] = int(fields[1])
    return found


class LocalSlurm:
    """with LocalSlurm(folder) as slurm: job = slurm.submit("my.sbatch"); print(slurm.wait(job))

    A node that was killed is called down after about down_after_s + 11 s; its jobs are then queued again and begin requeue_s
    later: 23 s in all. kill_wait_s passes between a job's SIGTERM, at its time limit, and its SIGKILL."""

    LEAST_REQUEUE_S = 5  # credentials would expire before a busy machine has started the job

    def __init__(self, folder, nodes=2, *, cpus=2, memory_mb=4000, down_after_s=6, requeue_s=6, kill_wait_s=10,
                 max_array_size=10001, timeout=60.0):
        self.folder = pathlib.Path(folder).absolute()
        self.nodes = tuple(f"node{i + 1}" for i in range(nodes))
        self.timeout = timeout
        if requeue_s < self.LEAST_REQUEUE_S:
            raise ValueError(f"requeue_s {requeue_s}: at least {self.LEAST_REQUEUE_S}")
        self._settings = {"down_after_s": down_after_s, "requeue_s": requeue_s, "kill_wait_s": kill_wait_s,
                          "max_array_size": max_array_size}
        self._node_line = f"CPUs={cpus} RealMemory={memory_mb}"
        self._daemons = {}
        self._stack = contextlib.ExitStack()

    # The cluster as a whole

    def __enter__(self):
        with self._stack:
            self._prepare()
            for name in ("munged", "slurmctld", *reversed(self.nodes)):  # the last one goes first
                self._stack.callback(self.kill_node if name in self.nodes else self._kill_daemon, name)
            self._start("munged", "munged", "--foreground", f"--socket={self.folder}/munge.socket",
                        f"--key-file={self.folder}/munge.key", f"--pid-file={self.folder}/munged.pid",
                        f"--seed-file={self.folder}/munged.seed", f"--log-file={self.folder}/munged.log")
            self._until(lambda: (self.folder / "munge.socket").exists(), "munged makes no socket")
            self._start("slurmctld", "slurmctld", "-D")
            for name in self.nodes:
                self._start(name, "slurmd", "-D", "-N", name)
            self.wait_nodes("idle")
            self._stack = self._stack.pop_all()
        return self

    def __exit__(self, *_):
        self._stack.close()

    def environment(self):
        """For sbatch and all others: this process's, without another Slurm's variables."""
        kept = {key: value for key, value in os.environ.items() if not re.match(r"(SLURM|SBATCH|SQUEUE|SINFO|SCANCEL)", key)}
        return {**kept, "PATH": PATH, "SLURM_CONF": str(self.folder / "slurm.conf")}

    def call(self, *command, timeout=60.0, **options):
        """Standard output of a command in the cluster's environment; SlurmError if it fails."""
        try:
            done = subprocess.run([str(word) for word in command], env=self.environment(), stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, timeout=timeout, check=False, **options)
        except subprocess.TimeoutExpired:
            raise self._error(f"{command[0]} did not end within {timeout:g} s") from None
        if done.returncode:
            raise SlurmError(f"{' '.join(map(str, command))}: exit code {done.returncode}: {done.stderr.strip()}")
        return done.stdout

    def _prepare(self):
        lacking = missing_programs()
        if lacking:
            raise SlurmError(f"not installed: {', '.join(lacking)} (Debian: munge slurmctld slurmd slurm-client)")
        if not re.fullmatch(r"[A-Za-z0-9_./+-]+", str(self.folder)):
            raise SlurmError(f"{self.folder}: slurm.conf knows no quotes: letters, digits and _./+- only")
        longest = max(len(f"{self.folder}/munge.socket"), len(f"{self.folder}/node99/node99_99999_9999.4294967291"))
        if longest > LONGEST_SOCKET:
            raise SlurmError(f"{self.folder}: {longest - LONGEST_SOCKET} letters too long for the sockets in it")
        self.folder.mkdir(parents=True, exist_ok=True)
        lock = self._stack.enter_context(open(self.folder / "lock", "w"))
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise SlurmError(f"{self.folder}: another cluster runs in it") from None
        for name in self.nodes:
            self.kill_node(name)  # what an earlier cluster left when its process was killed
        for old in (*self.folder.glob("*.log"), *self.folder.glob("*.out"), self.folder / "munge.socket"):
            old.unlink(missing_ok=True)
        for name in ("state", *self.nodes):
            shutil.rmtree(self.folder / name, ignore_errors=True)
            (self.folder / name).mkdir(mode=0o755)
        key = self.folder / "munge.key"
        key.unlink(missing_ok=True)
        with open(os.open(key, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
            file.write(secrets.token_bytes(128))
        controller_port, *ports = free_ports(1 + len(self.nodes))
        text = CONF.format(folder=self.folder, user=pwd.getpwuid(os.geteuid()).pw_name, controller_port=controller_port,
                           listen=listening(), **self._settings)
        for name, port in zip(self.nodes, ports):
            text += f"NodeName={name} NodeHostname=localhost NodeAddr=127.0.0.1 Port={port} {self._node_line}\n"
        text += "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n"
        (self.folder / "slurm.conf").write_text(text)

    def _start(self, name, program, *arguments):
        """In the foreground, and killed by the kernel should this process end without a word."""
        place = self.folder / name if name in self.nodes else self.folder
        with open(self.folder / f"{name}.out", "ab") as out:
            self._daemons[name] = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", program, *arguments], cwd=place,
                                                   env=self.environment(), stdin=subprocess.DEVNULL, stdout=out,
                                                   stderr=subprocess.STDOUT, start_new_session=True)

    def _kill_daemon(self, name):
        self._kill(lambda: self._with_children(self._alive(name)))
        self._daemons.pop(name, None)

    # Nodes

    def node_states(self):
        """{name: idle, mixed, allocated, down, ...}; a * behind it: it does not answer."""
        told = self.call("sinfo", "-h", "-N", "-o", "%N %T").split()
        return dict(zip(told[::2], told[1::2]))

    def wait_nodes(self, state, names=None, timeout=None):
        names = self.nodes if names is None else names

        def there():
            with contextlib.suppress(SlurmError):  # slurmctld does not answer yet
                states = self.node_states()
                return all(re.fullmatch(state, states.get(name, "")) for name in names)
        self._until(there, f"{', '.join(names)}: not {state}", timeout)

    def kill_node(self, name):
        """As a power cut would: slurmd, its slurmstepd and all that they started, by SIGKILL; slurmctld finds out by itself."""
        self._kill(lambda: self._node_processes(name))
        self._daemons.pop(name, None)

    def start_node(self, name, timeout=None):
        """Again, after kill_node; back when slurmctld takes jobs for it."""
        if name in self._daemons:
            raise SlurmError(f"{name} runs")
        self._start(name, "slurmd", "-D", "-N", name)
        self.wait_nodes("idle|mixed|allocated", [name], timeout)

    def node_pids(self, name):
        """What runs of a node: slurmd, slurmstepd, tasks."""
        return sorted(self._node_processes(name))

    def _node_processes(self, name):
        # slurmstepd leaves its parent and its environment behind, but keeps its log open; tasks are below it, or know their node.
        log, conf = f"{self.folder}/{name}.log", f"SLURM_CONF={self.folder}/slurm.conf".encode()
        node = f"SLURMD_NODENAME={name}".encode()
        found = self._alive(name)
        for pid in processes():
            with contextlib.suppress(OSError):  # another user's, or it ended meanwhile
                if pathlib.Path(os.readlink(f"/proc/{pid}/exe")).name.startswith(("slurmd", "slurmstepd")):
                    if any(os.readlink(entry.path) == log for entry in os.scandir(f"/proc/{pid}/fd")):
                        found.add(pid)
                environment = pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
                if node in environment and conf in environment:
                    found.add(pid)
        return self._with_children(found) - {os.getpid()}

    def _alive(self, name):
        daemon = self._daemons.get(name)
        return {daemon.pid} if daemon and daemon.poll() is None else set()

    @staticmethod
    def _with_children(pids):
        parents = processes()
        found, size = set(pids), 0
        while size != len(found):
            size = len(found)
            found |= {pid for pid, parent in parents.items() if parent in found}
        return found

    def _kill(self, find):
        """What find() finds, until it finds nothing: a process may have begun while the others were killed."""
        end = time.monotonic() + self.timeout
        while pids := find():
            if time.monotonic() > end:
                raise self._error(f"processes {sorted(pids)} do not die")
            for pid in pids:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            time.sleep(0.05)

    # Jobs

    def submit(self, *arguments):
        """Id that sbatch told."""
        return int(self.call("sbatch", "--parsable", *arguments).split(";")[0])

    def jobs(self, job_id=None):
        """All jobs, those that ended too; an array's tasks one by one."""
        fields = ("ArrayJobID", "ArrayTaskID", "State", "exit_code", "RestartCnt", "ReasonList", "NodeList", "Name")
        # A field is cut after as many letters as are asked for.
        asked = ",".join(f"{field}:{250 if field == 'Name' else 60}" for field in fields)
        told = self.call("squeue", "-h", "-r", "--states=all", "-O", asked, *(("-j", job_id) if job_id is not None else ()))
        return [self._job(line) for line in told.splitlines() if line.strip()]

    @staticmethod
    def _job(line):
        array, task, state, code, restarts, reason, node, name = (
            *(line[60 * i:60 * i + 60].strip() for i in range(7)), line[420:].strip())
        task = int(task) if task.isdigit() else None
        status = int(code)  # as of wait()
        return Job(id=array if task is None else f"{array}_{task}", array=int(array), task=task, state=state,
                   exit_code=128 + (status & 127) if status & 127 else status >> 8, node=node, reason=reason,
                   restarts=int(restarts), name=name)

    def wait(self, job_id, timeout=None):
        """Jobs of job_id (an array's, sorted by task) when all have ended."""
        found = []

        def ended():
            found[:] = sorted(self.jobs(job_id), key=lambda job: job.task or 0)
            return found and all(job.ended for job in found)
        self._until(ended, lambda: f"job {job_id} has not ended: "
                    + ", ".join(f"{job.id} {job.state} {job.node or job.reason}" for job in found), timeout)
        return found

    # Waiting, and what to say when it was in vain

    def _until(self, happened, otherwise, timeout=None):
        timeout = self.timeout if timeout is None else timeout
        end = time.monotonic() + timeout
        while not happened():
            dead = [name for name, daemon in self._daemons.items() if daemon.poll() is not None]
            if dead or time.monotonic() > end:
                why = otherwise() if callable(otherwise) else otherwise
                raise self._error(f"{why}: {', '.join(dead)} ended" if dead else f"{why} within {timeout:g} s")
            time.sleep(0.1)

    def _error(self, what):
        told = [what]
        for path in sorted(self.folder.glob("*.log")) or sorted(self.folder.glob("*.out")):
            with contextlib.suppress(OSError):
                told += [f"--- the end of {path}", *path.read_text(errors="replace").splitlines()[-12:]]
        for path in sorted(self.folder.glob("*.out")):  # what came before a log could be opened
            if not path.with_suffix(".log").exists():
                told += [f"--- the end of {path}", *path.read_text(errors="replace").splitlines()[-12:]]
        return SlurmError("\n".join(told))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--nodes", type=int, default=2)
    parser.add_argument("--cpus", type=int, default=2, help="of each node")
    parser.add_argument("command", nargs="+", help="behind --")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        with LocalSlurm(arguments.folder, arguments.nodes, cpus=arguments.cpus) as slurm:
            code = subprocess.run(arguments.command, env=slurm.environment(), check=False).returncode
            return code if code >= 0 else 128 - code
    except SlurmError as error:
        print(f"local_slurm: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
