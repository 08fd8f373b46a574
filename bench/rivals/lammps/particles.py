#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the particles of a scene as a LAMMPS data file (atom_style sphere).

    particles.py settle 20 20 25 > settle.data
    particles.py gas 22 22 22 > gas.data

Every coordinate and velocity is a function of the particle's id, so that another code starts from the same doubles:

    id = 1 + ix + nx (iy + ny iz)
    u(c) = (splitmix64(12345 + 8 id + c) >> 11) 2^-53,    c = 0..2 position, 3..5 velocity

    settle   centre (k + .5) 1.2 + .08 (2u - 1),  velocity .5 (2u - 1);       box 1.2 nx, 1.2 ny periodic, floor z = 0
    gas      centre (k + .5) a + .25 a (2u - 1),  velocity sqrt(3) (2u - 1);  box a nx, a ny, a nz periodic

a = (pi / (6 phi))^(1/3) with phi = .05 is 2.188 d; the jitter leaves at least .09 d between two neighbours.
A velocity component of the gas has variance 1, so its temperature starts at 1.
"""

import math
import sys

MASK = (1 << 64) - 1
PHI = 0.05  # volume fraction of the gas


def splitmix64(state):
    """The output for this state; the golden-ratio constant is added first."""
    state = (state + 0x9E3779B97F4A7C15) & MASK
    state = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    state = ((state ^ (state >> 27)) * 0x94D049BB133111EB) & MASK
    return state ^ (state >> 31)


def signed_unit(particle_id, component):
    """2u - 1: uniform in [-1, 1), a multiple of 2^-52, without rounding."""
    return 2.0 * ((splitmix64(12345 + 8 * particle_id + component) >> 11) * 2.0**-53) - 1.0


def unit_mass_density():
    """The double next to 6/pi for which LAMMPS computes a mass of 1 to the last bit.

    LAMMPS multiplies from left to right: 4 pi / 3 * r * r * r * density.
    """
    volume = 4.0 * math.pi / 3.0 * 0.5 * 0.5 * 0.5
    nominal = 6.0 / math.pi
    for candidate in (nominal, math.nextafter(nominal, 2.0), math.nextafter(nominal, 1.0)):
        if volume * candidate == 1.0:
            return candidate
    raise ArithmeticError("no double next to 6/pi gives a mass of exactly 1")


def write(scene, cells, out):
    nx, ny, nz = cells
    if scene == "settle":
        spacing, jitter, speed = 1.2, 0.08, 0.5
    else:
        spacing = (math.pi / (6.0 * PHI)) ** (1.0 / 3.0)
        jitter, speed = 0.25 * spacing, math.sqrt(3.0)
    # Nothing bounces higher than it fell, but the lid of the settle box must not be met by the first random velocities.
    height = spacing * nz + (2.0 if scene == "settle" else 0.0)
    density = unit_mass_density()

    out.write(f"{scene} {nx} x {ny} x {nz}\n\n{nx * ny * nz} atoms\n1 atom types\n\n")
    out.write(f"0 {spacing * nx!r} xlo xhi\n0 {spacing * ny!r} ylo yhi\n0 {height!r} zlo zhi\n")
    out.write("\nAtoms # sphere\n\n")
    for iz in range(nz):
        for iy in range(ny):
            for ix in range(nx):
                particle_id = 1 + ix + nx * (iy + ny * iz)
                x, y, z = ((k + 0.5) * spacing + jitter * signed_unit(particle_id, c)
                           for c, k in enumerate((ix, iy, iz)))
                out.write(f"{particle_id} 1 1.0 {density!r} {x!r} {y!r} {z!r}\n")
    out.write("\nVelocities\n\n")
    for particle_id in range(1, nx * ny * nz + 1):
        vx, vy, vz = (speed * signed_unit(particle_id, c) for c in (3, 4, 5))
        out.write(f"{particle_id} {vx!r} {vy!r} {vz!r} 0 0 0\n")


def main():
    arguments = sys.argv[1:]
    if len(arguments) != 4 or arguments[0] not in ("settle", "gas"):
        sys.exit("usage: particles.py settle|gas NX NY NZ > FILE")
    write(arguments[0], tuple(int(a) for a in arguments[1:]), sys.stdout)


if __name__ == "__main__":
    main()
