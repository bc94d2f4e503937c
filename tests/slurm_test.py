#!/usr/bin/env python3
"""Tests `duet slurm` against Slurm itself: slurmctld, slurmd and munged, on this machine and its loopback interface.

    tests/slurm_test.py PROGRAM      the program `duet`

Installs Debian's packages if they are missing, and exits with 77 and a reason where that cannot be done. All files of
the daemons are in a temporary folder; whatever was started is stopped in the end.
"""
import contextlib
import getpass
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

PACKAGES = ["slurmctld", "slurmd", "slurm-client", "munge"]
PROGRAMS = ["slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol", "sinfo", "munged"]
NODES = 4
SKIPPED = 77
os.environ["PATH"] += ":/usr/sbin:/sbin"

SCENE = """<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="12"/><integer name="rr_depth" value="100"/></integrator>
<sensor type="perspective"><float name="fov" value="90"/>
  <transform name="to_world"><lookat origin="0,0,2" target="0,0,0" up="0,1,0"/></transform>
  <sampler type="independent"><integer name="sample_count" value="16"/></sampler>
  <film type="hdrfilm"><integer name="width" value="48"/><integer name="height" value="32"/>
    <string name="component_format" value="float32"/><rfilter type="gaussian"/></film></sensor>
<shape type="sphere"><float name="radius" value="9"/>
  <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.9"/></bsdf></bsdf></shape>
<emitter type="point"><point name="position" x="0" y="0" z="3"/><rgb name="intensity" value="20"/></emitter>
</scene>
"""


def skip(reason):
    print("skipped:", reason)
    sys.exit(SKIPPED)


def install():
    """Installs what is missing, or skips the test."""
    if all(map(shutil.which, PROGRAMS)):
        return
    if not shutil.which("apt-get"):
        skip("there is no apt-get to install " + " ".join(PACKAGES))
    sudo = [] if os.geteuid() == 0 else ["sudo", "-n"]
    if sudo and not shutil.which("sudo"):
        skip("only root, or sudo, can install " + " ".join(PACKAGES))
    command = sudo + ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
    for arguments in (["update", "-qq"], ["install", "-y", "-qq", "--no-install-recommends"] + PACKAGES):
        done = subprocess.run(command + arguments, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    missing = [p for p in PROGRAMS if not shutil.which(p)]
    if done.returncode or missing:
        skip(f"{' '.join(PACKAGES)} cannot be installed: {(done.stderr.strip().splitlines() or missing)[-1]}")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def wait_for(what, state, seconds=60):
    """Waits until state() is true, and returns it."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = state()
        if value:
            return value
        time.sleep(0.1)
    raise AssertionError(f"waited {seconds} s in vain for {what}")


def configuration(folder, ports):
    user = getpass.getuser()
    nodes = "".join(f"NodeName=n{i + 1} NodeHostname=localhost NodeAddr=127.0.0.1 Port={port} CPUs=1\n"
                    for i, port in enumerate(ports[1:]))
    return f"""ClusterName=duet
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
CredType=cred/munge
# A requeued job waits until the credential of its first run is worth nothing.
AuthInfo=socket={folder}/munge/socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
MailProg=/bin/true
KillWait=20
{nodes}PartitionName=main Nodes=n[1-{NODES}] Default=YES MaxTime=INFINITE State=UP
"""


class Cluster:
    """The daemons, as long as it is entered."""

    def __init__(self, folder):
        self.folder = folder
        self.daemons = []

    def __enter__(self):
        try:
            self.start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        # Nodes and controller before what they speak through. What nodes run ends with their jobs.
        with contextlib.suppress(Exception):
            subprocess.run(["scancel", "--user", getpass.getuser()], timeout=10, capture_output=True)
            wait_for("the end of all jobs", lambda: not squeue("--noheader"), 15)
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def spawn(self, name, *command):
        with open(self.folder / (name + ".out"), "wb") as out:
            self.daemons.append(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=out))

    def start(self):
        munge = self.folder / "munge"
        for name in ["munge", "state"] + [f"spool-n{i + 1}" for i in range(NODES)]:
            (self.folder / name).mkdir(mode=0o755)
        (munge / "key").write_bytes(os.urandom(128))
        (munge / "key").chmod(0o400)
        self.spawn("munged", "munged", "--foreground", "--force", f"--socket={munge}/socket",
                   f"--key-file={munge}/key", f"--pid-file={munge}/pid", f"--log-file={munge}/log",
                   f"--seed-file={munge}/seed", "--num-threads=2")
        wait_for("munged", (munge / "socket").exists)
        conf = self.folder / "slurm.conf"
        conf.write_text(configuration(self.folder, free_ports(NODES + 1)))
        os.environ["SLURM_CONF"] = str(conf)
        self.spawn("slurmctld", "slurmctld", "-D")
        for i in range(NODES):
            self.spawn(f"slurmd-n{i + 1}", "slurmd", "-D", "-N", f"n{i + 1}")
        wait_for("all nodes", self.nodes_are_idle)

    def nodes_are_idle(self):
        assert all(d.poll() is None for d in self.daemons), "a daemon has ended"
        sinfo = subprocess.run(["sinfo", "--noheader", "-N", "-o", "%T"], capture_output=True, text=True)
        return sinfo.stdout.split() == ["idle"] * NODES


def run(*command, code=0, **options):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, **options)
    assert done.returncode == code, f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def squeue(*options):
    return run("squeue", "--array", *options).split("\n")[:-1]


def state(job):
    """RUNNING, PENDING, CANCELLED, FAILED, COMPLETED, TIMEOUT … of a job or a task."""
    return re.search(r"JobState=(\S+)", run("scontrol", "show", "job", job))[1]


def is_over(job):
    return state(job) not in ("PENDING", "RUNNING", "COMPLETING", "REQUEUED", "SUSPENDED")


def pixels(path):
    """All of an OpenEXR file that is not its header: lines of pixels, as they are stored."""
    data = path.read_bytes()
    assert data[:4] == b"\x76\x2f\x31\x01", f"{path} is no OpenEXR file"
    at, attributes = 8, {}
    while data[at]:
        name, kind = data[at:].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", data, at)
        attributes[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    first, = struct.unpack_from("<Q", data, at + 1)
    return attributes["channels"], attributes["compression"], attributes["dataWindow"], data[first:]


def samples_in(program, folder, seconds):
    """The samples per pixel that one thread takes in this time."""
    run(program, "room.xml", "--time", f"{seconds}s", "-t", "1", "-q", "-o", "timed.exr", "--stats", "timed.json",
        cwd=folder)
    return json.loads((folder / "timed.json").read_text())["spp"]


def submit(program, folder, image, tasks, *options):
    """Submits the scene; the numbers of both jobs."""
    said = run(program, "slurm", "room.xml", "--tasks", str(tasks), "-o", image, *options, cwd=folder)
    return re.search(r"are job (\d+), their merge is job (\d+)", said).groups()


def lost_slices(log):
    """What a merge says of the slices that lack samples: number, samples and command."""
    return re.findall(r"error: slice (\d+)/\d+ lacks the samples (\S+); render them with: (.*)", log)


def test_loss(program, folder, spp):
    """One task is cancelled while it runs, one before, one is requeued; what is lost can be rendered again."""
    tasks = 5
    image = folder / "it's 100% #1.exr"
    jobs = image.with_suffix(".slurm")
    array, merge = submit(program, folder, image.name, tasks, "--", "--spp", str(spp), "--checkpoint", "1s")
    run("scancel", f"{array}_5")

    def film(k):
        return jobs / f"{spp}spp-slice-{k}-of-{tasks}.exr"

    wait_for("checkpoints of the first tasks", lambda: film(1).exists() and film(2).exists(), 90)
    run("scancel", f"{array}_1")
    run("scontrol", "requeue", f"{array}_2")
    wait_for("the merge", lambda: is_over(merge), 120)
    assert state(f"{array}_2") == state(f"{array}_3") == "COMPLETED"
    assert state(f"{array}_1") == "CANCELLED"
    assert state(merge) == "FAILED", state(merge)

    requeued = (jobs / "slice-2.log").read_text()
    assert "DUE TO JOB REQUEUE" in requeued and "goes on from" in requeued, requeued
    log = (jobs / "merge.log").read_text()
    assert "duet: stopping" in (jobs / "slice-1.log").read_text()
    lost = lost_slices(log)
    assert [k for k, _, _ in lost] == ["1", "5"], log
    # The first had got some samples when it was cancelled.
    part, end = map(int, lost[0][1].split(":"))
    assert 0 < part < end == spp // tasks, log
    assert lost[1][1] == f"{spp * 4 // tasks}:{spp}" and not film(5).exists(), log
    run(program, "room.xml", "--spp", str(spp), "-o", "whole.exr", cwd=folder)
    assert pixels(image)[-1] != pixels(folder / "whole.exr")[-1]

    for _, _, command in lost:
        run("bash", "-c", command, cwd=folder)
    run("bash", str(jobs / "merge.sh"), cwd=folder)
    assert pixels(image) == pixels(folder / "whole.exr"), "the pixels are not those of one render"


def test_time_limit(folder, array, merge):
    """A task that is longer than its limit is told to stop before it, and leaves its raw film."""
    wait_for("the end of the time", lambda: is_over(merge), 150)
    jobs = folder / "long.slurm"
    log = (jobs / "slice-1.log").read_text()
    assert "duet: stopping" in log and "TIME LIMIT" not in log, log
    assert state(f"{array}_1") == "FAILED"  # and not TIMEOUT
    (_, missing, _), = lost_slices((jobs / "merge.log").read_text())
    assert int(missing.split(":")[0]) > 0, missing
    assert (folder / "long.exr").exists()


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    install()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="duet-slurm-") as name:
        folder = pathlib.Path(name)
        folder.chmod(0o755)
        place = folder / "a place"
        place.mkdir()
        (place / "room.xml").write_text(SCENE)
        try:
            with Cluster(folder):
                # A slice takes some seconds, so that it can be caught at work.
                spp = 5 * max(samples_in(program, place, 2) * 3, 10)
                # Slurm looks at time limits twice a minute: the other jobs run meanwhile.
                limited = submit(program, place, "long.exr", 1, "--sbatch", "--time=2", "--", "--spp", "1000000000")
                test_loss(program, place, spp)
                test_time_limit(place, *limited)
        except BaseException:
            for log in sorted(folder.rglob("*.log")) + sorted(folder.glob("*.out")):
                print(f"==> {log.relative_to(folder)} <==\n{log.read_text(errors='replace')[-3000:]}")
            raise
    seconds = time.monotonic() - start
    print(f"2 tasks cancelled, 1 requeued, 1 at its time limit, and the same image, in {seconds:.0f} s")


main()
