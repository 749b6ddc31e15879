#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A survey on a real Slurm of one node and of two, beside `sonarx run --jobs 1` in the same rounds (tools/setup.sh cluster).
   bench/cluster.py PROGRAM FOLDER [--rounds 4] [--pings 150]
Prints medians and their ratios, after the three results were found equal byte for byte."""
import argparse
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "cluster"))
import local_slurm  # noqa: E402

OBSERVATIONS = 4


def sonarx(program, *words, **more):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False, **more)
    if done.returncode != 0:
        raise SystemExit(f"sonarx {' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
    return done.stdout


def result(out):
    names = ["schools.csv", "school_pings.csv", "survey.gpkg", "survey.json",
             *(f"products/obs-000{i}.nc" for i in range(1, OBSERVATIONS + 1))]
    return {name: (out / name).read_bytes() for name in names}


def empty(folder):
    shutil.rmtree(folder, ignore_errors=True)
    return folder


def laptop(program, survey, out):
    start = time.monotonic()
    sonarx(program, "run", survey, "--out", empty(out), "--jobs", 1)
    return time.monotonic() - start


def cluster(program, survey, folder, nodes):
    """Seconds until the array is done, and until the merge is."""
    out = empty(folder / "out")
    with local_slurm.LocalSlurm(folder / "slurm", nodes=nodes, cpus=1) as slurm:
        start = time.monotonic()
        told = sonarx(program, "submit", survey, "--out", out, "--cpus", 1, env={**os.environ, **slurm.environment()})
        array, merge = re.findall(r"(?:array|merge) job (\d+)", told)
        slurm.wait(array, timeout=600)
        arrays = time.monotonic() - start
        slurm.wait(merge, timeout=600)
        return arrays, time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=4)
    parser.add_argument("--pings", type=int, default=150)
    wanted = parser.parse_args()
    missing = local_slurm.missing_programs()
    if missing:
        raise SystemExit(f"not installed (tools/setup.sh cluster): {', '.join(missing)}")
    program, folder = wanted.program.resolve(), wanted.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    survey = empty(folder / "survey")
    sonarx(program, "simulate", survey, "--preset", "easy", "--seed", 4, "--observations", OBSERVATIONS,
           "--pings", wanted.pings, "--schools", 2)
    megabytes = sum(p.stat().st_size for p in survey.glob("*.raw")) / 1e6
    alone, of_nodes = [], {1: [], 2: []}
    for done in range(1, wanted.rounds + 1):
        alone.append(laptop(program, survey, folder / "laptop"))
        expected = result(folder / "laptop")
        for nodes, times in of_nodes.items():
            times.append(cluster(program, survey, folder, nodes))
            if result(folder / "out") != expected:
                raise SystemExit(f"{nodes} nodes: another result than run's")
        print(f"round {done}: run {alone[-1]:.1f} s; " +
              ", ".join(f"{n} nodes {t[-1][0]:.1f} s, merged {t[-1][1]:.1f} s" for n, t in of_nodes.items()), flush=True)
    of_run = statistics.median(alone)
    one, two = ([statistics.median(part) for part in zip(*of_nodes[n])] for n in (1, 2))
    print(f"{OBSERVATIONS} observations of {wanted.pings} pings, {megabytes:.0f} MB; medians of {wanted.rounds} rounds, equal results")
    print(f"run --jobs 1 {of_run:.1f} s; one node {one[0]:.1f} s (merged {one[1]:.1f}); two {two[0]:.1f} s (merged {two[1]:.1f})")
    print(f"one node : two nodes = {one[0] / two[0]:.2f}; one node : run = {one[1] / of_run:.2f}")


if __name__ == "__main__":
    main()
