#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does h5py read what tsubu wrote, and is it H5MD 1.1? Compares with what write_h5md_examples puts in.

check_h5md.py PROGRAM   runs PROGRAM FOLDER first, which writes the files into a folder that goes afterwards
check_h5md.py FOLDER    checks the files that are there

Exit code: 0 equal, 1 not equal, 2 usage.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

COUNTS = [3, 0, 5]
UNITS = {"position": "m", "velocity": "m s-1", "mass": "kg", "angular_velocity": "rad s-1", "stress": "Pa",
         "acceleration": "m s-2"}


class Wrong(Exception):
    pass


def same(what, found, wanted):
    if not np.array_equal(np.asarray(found), np.asarray(wanted)):
        raise Wrong(f"{what}: {found!r}, not {wanted!r}")


def text(value):
    return value.decode() if isinstance(value, bytes) else value


def check_text(group, name, wanted, is_variable):
    """The attribute has this text, and lies in the file as H5MD says: scalar, of fixed or of variable length."""
    attribute = group.attrs.get_id(name)
    same(f"{group.name}@{name}", text(group.attrs[name]), wanted)
    same(f"{group.name}@{name}: extents", attribute.shape, ())
    if attribute.get_type().is_variable_str() != is_variable:
        raise Wrong(f"{group.name}@{name}: of variable length: {not is_variable}")


def check_metadata(file):
    h5md = file["h5md"]
    same("version", h5md.attrs["version"], [1, 1])
    if not np.issubdtype(h5md.attrs["version"].dtype, np.integer):
        raise Wrong("version is no integer")
    check_text(h5md["author"], "name", "Zo\u00eb", False)
    check_text(h5md["author"], "email", "zoe@example.org", False)
    check_text(h5md["creator"], "name", "example", False)
    check_text(h5md["creator"], "version", "1.2", False)
    same("units", h5md["modules/units"].attrs["version"], [1, 0])
    check_text(h5md["modules/units"], "system", "SI", True)


def check_box(group, dimension, boundary, edges, corners):
    box = group["box"]
    same("dimension", box.attrs["dimension"], dimension)
    same("dimension: extents", box.attrs.get_id("dimension").shape, ())
    same("boundary", [text(word) for word in box.attrs["boundary"]], boundary)
    if box.attrs.get_id("boundary").get_type().is_variable_str():
        raise Wrong("boundary is not of fixed length")
    same("edges", box["edges/value"][...], edges)
    same("lower", box["lower/value"][...], [corners[0]] * 3)
    same("upper", box["upper/value"][...], np.add([corners[0]] * 3, corners[1]))
    for name in ("edges", "lower", "upper"):
        check_text(box[name]["value"], "unit", "m", True)


def check_elements(group, d):
    fields = ["id", "species", "position", "velocity", "image", "mass", "angular_velocity", "frozen", "phase", "stress",
              "acceleration"]
    same("elements", sorted(group), sorted(fields + ["box"]))
    for name in fields + ["box/edges", "box/lower", "box/upper"]:
        element = group[name]
        same(f"{name}: members", sorted(element), ["step", "time", "value"])
        for shared in ("step", "time"):  # hard links to one dataset
            if element[shared] != group["position"][shared] or not isinstance(
                    element.get(shared, getlink=True), h5py.HardLink):
                raise Wrong(f"{name}/{shared} is not that of position")
        if element["value"].shape[0] != 3:
            raise Wrong(f"{name}: {element['value'].shape}")
        if name in UNITS:
            check_text(element["value"], "unit", UNITS[name], True)
        elif not name.startswith("box") and "unit" in element["value"].attrs:
            raise Wrong(f"{name} has a unit")
    same("step", group["position/step"][...], [100, 200, 300])
    same("step: type", group["position/step"].dtype, np.int64)
    same("time", group["position/time"][...], [0, 0.5, 1])
    check_text(group["position/time"], "unit", "s", True)

    types = {"id": np.int64, "species": np.int32, "position": np.float64, "velocity": np.float32, "image": np.int64,
             "mass": np.float64, "frozen": np.bool_, "phase": np.int16, "stress": np.float64,
             "acceleration": np.float32}
    shapes = {"position": (d,), "velocity": (d,), "image": (d,), "stress": (3, 3), "acceleration": (3,),
              "angular_velocity": (1 if d == 2 else 3,)}
    for name in fields:
        value = group[name]["value"]
        same(f"{name}: extents", value.shape, (3, 5) + shapes.get(name, ()))
        if name in types and value.dtype != types[name]:
            raise Wrong(f"{name}: {value.dtype}, not {types[name]}")
    same("id: fill", group["id/value"].fillvalue, -1)
    ids = group["id/value"][...]
    for k, count in enumerate(COUNTS):
        number = 10 * np.arange(count) + k
        row = {name: group[name]["value"][k] for name in fields}
        same("id", ids[k], list(number) + [-1] * (5 - count))
        same("species", row["species"][:count], -number)
        for j in range(d):
            same("position", row["position"][:count, j], number + 0.125 * j)
            same("velocity", row["velocity"][:count, j], (number / 4).astype(np.float32))
            same("image", row["image"][:count, j], number - 1)
        same("mass", row["mass"][:count], 0.1 * number)
        same("angular_velocity", row["angular_velocity"][:count, 0], number)
        same("frozen", row["frozen"][:count], np.arange(count) % 2 == 0)
        same("phase", row["phase"][:count], [300] * count)
        same("stress", row["stress"][:count, 1, 2], number)
        same("stress", row["stress"][:count, 2, 1], [0] * count)
        if not np.isnan(row["position"][count:]).all():
            raise Wrong("positions of nobody are not NaN")


def check(folder):
    def lengths(edges, last):
        return [edges, edges, edges[:-1] + [last]]
    tilted = [[2, 0, 0], [0.5, 4, 0], [0.25, 0.125, 6]]
    later = [[2, 0, 0], [0.5, 4, 0], [0.25, 0.125, 8]]
    boxes = {
        "straight.h5": (3, ["periodic", "none", "periodic"], lengths([2, 4, 6], 8),
                        ([-1, -2, -3], lengths([2, 4, 6], 8))),
        "flat.h5": (2, ["none", "none"], lengths([2, 4], 8), ([0, 0], lengths([2, 4], 8))),
        "tilted.h5": (3, ["periodic"] * 3, [tilted, tilted, later], ([0, 0, 0], lengths([2, 4, 6], 8))),
    }
    failed = False
    for name, box in boxes.items():
        try:
            with h5py.File(Path(folder) / name, "r") as file:
                same("root", sorted(file), ["h5md", "particles"])
                check_metadata(file)
                group = file["particles/grains"]
                check_box(group, *box)
                check_elements(group, box[0])
            print(f"{name}: equal")
        except (Wrong, OSError, KeyError, ValueError, TypeError, AttributeError) as wrong:
            print(f"{name}: {wrong}")
            failed = True
    print(f"{len(boxes)} files, h5py {h5py.version.version}, HDF5 {h5py.version.hdf5_version}: "
          + ("NOT EQUAL" if failed else "all equal"))
    return 1 if failed else 0


def main(words):
    if len(words) != 2:
        print(__doc__)
        return 2
    if Path(words[1]).is_dir():
        return check(words[1])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([words[1], folder], check=True)
        return check(folder)


if __name__ == "__main__":
    sys.exit(main(sys.argv))
