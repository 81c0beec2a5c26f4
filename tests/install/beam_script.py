# SPDX-License-Identifier: GPL-2.0-or-later
"""A LAMMPS script of a beam that stretches in a field, for tests of programs that run it: it takes what
`magfsi lammps lattice beam` has written."""


def script(digits):
    """Prints the potential energy [J] with so many digits after the point."""
    return f"""units si
atom_style sphere
atom_modify map array sort 0 0.0
newton on
boundary s s s
comm_modify mode single cutoff 3e-3 vel yes
neighbor 1e-4 bin
neigh_modify once yes
read_data beam.data
fix beam all magttice beam.lattice 1 330e3 6.6e6 field 0 0 5e-3
fix go all nve
timestep 5e-6
thermo_style custom step pe
thermo_modify norm no format float %.{digits}e
run 200
"""
