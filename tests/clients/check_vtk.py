#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does VTK read what tsubu wrote? Opens each .vtp and .pvtp file with VTK, and compares with the .txt file beside it.

check_vtk.py PROGRAM   runs PROGRAM FOLDER first, which writes the files into a folder that goes afterwards
check_vtk.py FOLDER    checks the files that are there

Exit code: 0 equal, 1 not equal, 2 usage.
"""
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import vtk

INTEGERS = {8: ("SignedChar", "UnsignedChar"), 16: ("Short", "UnsignedShort"), 32: ("Int", "UnsignedInt"),
            64: ("Long", "UnsignedLong")}
# VTK names its classes after C types, and may use a class of fixed size instead.
CLASSES = {"Float": {"vtkFloatArray"}, "Double": {"vtkDoubleArray"}}
for bits, (signed, unsigned) in INTEGERS.items():
    CLASSES[f"TypeInt{bits}"] = {f"vtk{signed}Array", f"vtkTypeInt{bits}Array", "vtkIdTypeArray"}
    CLASSES[f"TypeUInt{bits}"] = {f"vtk{unsigned}Array", f"vtkTypeUInt{bits}Array"}
    if bits == 64:
        CLASSES["TypeInt64"].add("vtkLongLongArray")
        CLASSES["TypeUInt64"].add("vtkUnsignedLongLongArray")


def expected(path):
    """The number of points, and a list of (name, components, type, unit, rows of words)."""
    lines = path.read_text().split("\n")
    count = int(lines[0].split()[1])
    arrays, at = [], 1
    while at < len(lines) and lines[at]:
        _, components, kind, unit, name = lines[at].split(" ", 4)
        rows = [line.split() for line in lines[at + 1:at + 1 + count]]
        arrays.append((name, int(components), kind, unit, rows))
        at += 1 + count
    return count, arrays


def same(found, word, kind):
    if kind in ("Float", "Double"):  # 17 digits tell both: Python holds a float as a double
        return found == float(word) and math.copysign(1, found) == math.copysign(1, float(word))
    return found == int(word)


def breaches(path):
    reader = vtk.vtkXMLPPolyDataReader() if path.suffix == ".pvtp" else vtk.vtkXMLPolyDataReader()
    if not reader.CanReadFile(str(path)):
        return ["VTK cannot read it"]
    refused = []
    reader.AddObserver("ErrorEvent", lambda *_: refused.append("VTK tells an error"))
    reader.AddObserver("WarningEvent", lambda *_: refused.append("VTK warns"))
    reader.SetFileName(str(path))
    reader.Update()
    if refused:
        return refused
    found = reader.GetOutput()
    count, arrays = expected(Path(str(path) + ".txt"))
    wrong = []
    for what, number in (("points", found.GetNumberOfPoints()), ("vertices", found.GetNumberOfVerts()),
                         ("cells", found.GetNumberOfCells())):
        if number != count:
            wrong.append(f"{number} {what}, not {count}")
    names = [found.GetPointData().GetArrayName(k) for k in range(found.GetPointData().GetNumberOfArrays())]
    if names != [name for name, *_ in arrays[1:]]:
        wrong.append(f"arrays {names}")
    if wrong:
        return wrong
    for i in range(count):
        if found.GetCellType(i) != vtk.VTK_VERTEX or found.GetCell(i).GetPointId(0) != i:
            return [f"cell {i} is not the vertex of point {i}"]
    for name, components, kind, unit, rows in arrays:
        array = found.GetPoints().GetData() if name == "position" else found.GetPointData().GetArray(name)
        if array.GetNumberOfComponents() != components or array.GetNumberOfTuples() != count:
            wrong.append(f"{name}: {array.GetNumberOfTuples()} of {array.GetNumberOfComponents()} components")
            continue
        if array.GetClassName() not in CLASSES[kind]:
            wrong.append(f"{name}: {array.GetClassName()}, not one of {sorted(CLASSES[kind])}")
        key = vtk.vtkDataArray.UNITS_LABEL()
        has = array.GetInformation().Get(key) if array.GetInformation().Has(key) else "-"
        if path.suffix == ".vtp" and has != unit:
            wrong.append(f"{name}: unit {has}, not {unit}")
        for i, row in enumerate(rows):
            values = [array.GetValue(i * components + k) for k in range(components)]  # GetTuple makes doubles of ids
            if len(row) != components or not all(same(value, word, kind) for value, word in zip(values, row)):
                wrong.append(f"{name}: particle {i}: {values}, not {row}")
                break
    return wrong


def check(folder):
    files = sorted(path for path in Path(folder).iterdir() if path.suffix in (".vtp", ".pvtp"))
    failed = not files
    for path in files:
        wrong = breaches(path)
        print(f"{path.name}: " + ("; ".join(wrong) or "equal"))
        failed |= bool(wrong)
    print(f"{len(files)} files, VTK {vtk.vtkVersion.GetVTKVersion()}: " + ("NOT EQUAL" if failed else "all equal"))
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
