#include "apps/voids_flags.h"

namespace interstice::apps {

void add_voids_flags(CLI::App& c, VoidsWords& words) {
  c.add_option(
       "inputs", words.inputs,
       "particle files: trajectory.h5part, LIGGGHTS/LAMMPS text dumps, VTK (legacy, .vtp, .vtu), CSV, "
       "YADE text, MercuryDPM .data, EDEM CSV and .h5; all but HDF5 also .gz (docs/FILES.md)")
      ->required();
  c.add_option("-o,--output", words.output, "folder for the results")->required();
  c.add_option("--voxel", words.voxel, "edge of a voxel, such as 20um")->required();
  c.add_option("--box", words.box, "x0,x1,y0,y1,z0,z1 with units (default: the particles' bounds)");
  c.add_option("--periodic", words.periodic, "axes along which the box repeats, such as xy");
  c.add_option("--method", words.method,
               "exact, centre, divided[:LEAST_VOID], subsample:N or kernel:LENGTH (docs/METHODS.md)");
  c.add_option("--overlap", words.overlap,
               "how places count that spheres share: sum (once for each) or union (once)");
  c.add_option("--quantities", words.quantities,
               "also velocity, temperature, diameter, coordination, stress, bonded: those wanted, such as "
               "velocity,coordination (docs/METHODS.md)");
  c.add_option(
       "--classes", words.classes,
       "solid fraction by class of grains: size:DIAMETER,..., such as size:20um,40um, material or layer")
      ->capture_default_str();
  c.add_option("--average", words.average, "also fields averaged over this length, such as 120um");
  c.add_option(
      "--average-window", words.average_window,
      "over what: box (a cube of that edge, default), sphere (of that diameter) or gaussian (of that "
      "cube's second moments)");
  c.add_flag("--scales", words.scales, "also scales.csv: void fraction against averaging length");
  c.add_option("--walls", words.walls,
               "FILE.stl@UNIT: solid inside a closed surface, such as blade.stl@mm (repeatable)")
      ->allow_extra_args(false);
  c.add_option("--solid", words.solids,
               "solid box:x0,x1,y0,y1,z0,z1, ball:x,y,z,RADIUS, cylinder:x0,y0,z0,x1,y1,z1,RADIUS or "
               "plane:x,y,z,nx,ny,nz (repeatable)")
      ->allow_extra_args(false);
  c.add_option("--slice", words.slices, "plane of voxels, such as x=4.5mm (repeatable)")
      ->allow_extra_args(false);
  c.add_option("--line", words.lines, "row of voxels, such as y@x=9mm,z=35um (repeatable)")
      ->allow_extra_args(false);
  c.add_option("--layers", words.layers, "z0,z1,NX,NY: packing of NX by NY columns between two heights");
  c.add_option("--density", words.density, "of the grains, where the file has none, such as 7800kg/m^3");
  c.add_option("--length-unit", words.length_unit, "unit of length of files that carry none (default m)");
  c.add_option("--frame", words.frame, "number from 0, last or all")->capture_default_str();
  c.add_option("--columns", words.columns, "OURS=THEIRS,...: columns by other names, such as radius=c_r");
  c.add_flag("--overwrite", words.overwrite, "replace results in the folder");
  c.add_flag("--no-figures", words.no_figures, "no figures");
  c.add_option("--figures", words.figures,
               "kinds of figures: png, and pdf or svg beside it, such as png,pdf");
  c.add_option("--contours", words.contours,
               "levels of the averaged void fraction drawn as lines on slices (default 0.4,0.5,0.6)");
  add_compute_options(c, words.compute);
}

}  // namespace interstice::apps
