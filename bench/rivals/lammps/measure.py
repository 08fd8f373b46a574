#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a scene in Debian's LAMMPS, pinned, and prints one line of JSON.

    measure.py settle --steps 5000                       20 x 20 x 25 spheres, falling
    measure.py settle --cells 50 50 40 --steps 5000      1e5 spheres
    measure.py settle --warmup 60000 --steps 5000        the dense bed, after the fall
    measure.py settle --restart bed.restart --steps 5000 the dense bed, from a file that --save wrote
    measure.py settle --data bed.data --steps 5000       from a data file of atom_style sphere
    measure.py gas --set restitution 0.9 --steps 30000

seconds is LAMMPS' own time of the steps alone, without reading and set-up. bytes_per_particle is the memory LAMMPS says
it allocated, where small scenes pay for whole pages of its lists; resident_bytes_per_particle is what the program grew
by over a run of the same scene with eight particles, reading included.
builds counts the rebuilds of the neighbour list within the timed steps. coordination leaves walls out.
Exits 3 if there is no lmp.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import particles

HERE = pathlib.Path(__file__).resolve().parent
CELLS = {"gas": (22, 22, 22)}
SETTLE_CELLS = (20, 20, 25)


def write_particles(scene, cells, path):
    with open(path, "w", encoding="ascii") as out:
        particles.write("gas" if scene == "gas" else "settle", cells, out)


def run(scene, settings):
    """Runs lmp on core 0; returns its output and its largest resident set in bytes."""
    command = ["taskset", "-c", "0", "lmp", "-in", f"{scene}.lmp", "-log", "none"]
    for name, value in settings.items():
        command += ["-var", name, *value.split(" ")]
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    with tempfile.TemporaryFile() as out:
        child = subprocess.Popen(command, cwd=HERE, env=environment, stdout=out, stderr=subprocess.STDOUT)
        # wait4 sees this child alone, not earlier ones.
        _, status, usage = os.wait4(child.pid, 0)
        out.seek(0)
        text = out.read().decode(errors="replace")
    errors = [line for line in text.splitlines() if line.startswith("ERROR")]
    if status != 0 or errors:
        sys.exit(f"lmp failed on {scene}: {errors[0] if errors else text[-500:]}")
    return text, usage.ru_maxrss * 1024


def tables(text):
    """The printed rows of each run, as dictionaries."""
    result = []
    names = None
    for line in text.splitlines():
        fields = line.split()
        if fields and fields[0] == "Step":
            names = fields
            result.append([])
        elif line.startswith("Loop time"):
            names = None
        elif names and len(fields) == len(names):
            result[-1].append(dict(zip(names, map(float, fields))))
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", choices=sorted(p.stem for p in HERE.glob("*.lmp") if p.stem not in ("begin", "end")))
    parser.add_argument("--steps", type=int, required=True, help="timed steps, at least one")
    parser.add_argument("--warmup", type=int, default=0, help="steps before the timed ones")
    parser.add_argument("--cells", type=int, nargs=3, metavar=("NX", "NY", "NZ"), help="particles along x, y and z")
    begin = parser.add_mutually_exclusive_group()
    begin.add_argument("--restart", help="start from this file instead of the formula")
    begin.add_argument("--data", help="start from this data file instead of the formula; it says where the box ends")
    parser.add_argument("--save", help="write a restart file at the end")
    parser.add_argument("--set", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"),
                        help="a variable of the scene")
    arguments = parser.parse_args()
    if shutil.which("lmp") is None:
        print("There is no lmp on the PATH; Debian's package lammps has it.", file=sys.stderr)
        return 3

    steps = str(arguments.steps)
    settings = {"steps": steps, "warmup": str(arguments.warmup), "every": steps}
    settings.update((name, value) for name, value in arguments.set)
    cells = tuple(arguments.cells or CELLS.get(arguments.scene, SETTLE_CELLS))
    with tempfile.TemporaryDirectory() as folder:
        few = os.path.join(folder, "few.data")
        write_particles(arguments.scene, (2, 2, 2), few)
        _, base = run(arguments.scene, dict(settings, file=few, steps="10", warmup="0"))
        if arguments.restart:
            settings.update(source="restart", file=os.path.abspath(arguments.restart))
        elif arguments.data:
            settings["file"] = os.path.abspath(arguments.data)
        else:
            settings["file"] = os.path.join(folder, "all.data")
            write_particles(arguments.scene, cells, settings["file"])
        if arguments.save:
            settings.update(saving="yes", save=os.path.abspath(arguments.save))
        text, resident = run(arguments.scene, settings)

    # Four runs: warm-up, timed, one that prints the memory, one that counts contacts. The timed one prints no memory.
    loops = re.findall(r"^Loop time of (\S+) on 1 procs for (\d+) steps with (\d+) atoms", text, re.MULTILINE)
    seconds, steps, count = float(loops[1][0]), int(loops[1][1]), int(loops[1][2])
    mebibytes = re.findall(r"^Per MPI rank memory allocation .* = \S+ \| (\S+) \|", text, re.MULTILINE)
    _, timed, _, contacts = tables(text)
    first, last, contacts = timed[0], timed[-1], contacts[0]
    print(json.dumps({
        "scene": arguments.scene,
        "particles": count,
        "first_step": int(first["Step"]),
        "steps": steps,
        "seconds": seconds,
        "mparticle_steps_per_s": round(count * steps / seconds / 1e6, 3) if seconds > 0 else None,
        "bytes_per_particle": round(float(mebibytes[1]) * 1024 * 1024 / count, 1),
        "resident_bytes_per_particle": round((resident - base) / count, 1),
        "builds": int(last["Nbuild"] - first["Nbuild"]),
        "dangerous_builds": int(last["Ndanger"] - first["Ndanger"]),
        "ke": last["KinEng"],
        "rot": last["c_rot"],
        "mean_z": last["c_mean_z"],
        "drift": [last["v_drift_x"], last["v_drift_y"], last["v_drift_z"]],
        "coordination": contacts["c_coordination"],
        "mass": [contacts["c_lightest"], contacts["c_heaviest"]],
    }))
    return 0


if __name__ == "__main__":
    sys.exit(main())
