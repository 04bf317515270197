#!/bin/sh
# Writes the samples of this folder again, with LIGGGHTS, LAMMPS and YADE as Debian 12 has them:
#   apt-get install liggghts lammps yade; ./make.sh
set -eu
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1  # in a container; else without meaning
cd "$(dirname "$0")"
here=$PWD
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cp liggghts.in lammps.in yade.py "$work"
cd "$work"
awk -v STYLE=script -f "$here/grains.awk" > grains.lmp
awk -v STYLE=yade -f "$here/grains.awk" > grains.py
liggghts -in liggghts.in > liggghts.log
lmp -in lammps.in > lammps.log
yade -n -x yade.py > yade.log 2>&1
gzip -9n liggghts-sixdigits.dump
mv yade-spheres-00000000.vtk yade.vtk
mv yade-spheres.0.vtu yade.vtu
mv liggghts-2000.vtk liggghts.vtk
for file in liggghts.dump liggghts-sixdigits.dump.gz liggghts-scaled.dump liggghts.vtk lammps-triclinic.dump \
  lammps-triclinic-scaled.dump.gz lammps-unwrapped.dump yade.txt yade-mass.txt yade.vtk yade.vtu; do
  cp "$file" "$here"
done
