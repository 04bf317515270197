# The grains of all samples here: 60 of 20 to 40 um on a loose 5 x 4 x 3 lattice of 60 um. STYLE=script gives commands for
# LIGGGHTS and LAMMPS, STYLE=yade a Python list of (x, y, z, r).
BEGIN {
  for (i = 0; i < 60; ++i) {
    x = 4e-5 + (i % 5) * 6e-5 + (i * 7 % 13) * 5.1234e-7
    y = 4e-5 + (int(i / 5) % 4) * 6e-5 + (i * 5 % 11) * 5.4321e-7
    z = 4e-5 + int(i / 20) * 6e-5 + (i * 3 % 7) * 5.0123e-7
    r = 1e-5 + (i % 11) * 1e-6
    if (STYLE == "yade")
      printf "%s(%.17g, %.17g, %.17g, %.17g),\n", i ? "" : "grains = [\n", x, y, z, r
    else
      printf "create_atoms 1 single %.17g %.17g %.17g\nset atom %d diameter %.17g density 7800\n", x, y, z, i + 1, 2 * r
  }
  if (STYLE == "yade") print "]"
}
