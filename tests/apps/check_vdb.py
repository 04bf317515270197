#!/usr/bin/env python3
"""Fields of `interstice voids` as another program reads them: python3-openvdb and numpy, nothing of ours.

    check_vdb.py INTERSTICE SAMPLE.dump      exit 0 all right, 77 where the modules are missing

The dump is read here by splitting lines; shares of voxels are counted with points. With 32^3 points a voxel,
of which the surface of a sphere passes some 3 * 32^2, a share is off by about sqrt(3 * 32^2) / 32^3 / 2 =
1e-3 at one standard deviation; 1e-2 is never reached.
"""
import subprocess
import sys
import tempfile

try:
    import numpy as np
    import pyopenvdb as vdb
except ImportError as missing:
    print(f"skipped: {missing} (apt-get install python3-openvdb python3-numpy)")
    sys.exit(77)

VOXEL = 15e-6
POINTS = 32


def last_frame(path):
    """Rows of the last frame of a text dump, by column name."""
    lines = open(path).read().split("\n")
    begin = max(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    names = lines[begin].split()[2:]
    rows = [line.split() for line in lines[begin + 1:] if line and not line.startswith("ITEM")]
    return {name: np.array([float(row[c]) for row in rows]) for c, name in enumerate(names)}


def sampled_share(lo, grains):
    """Share of the voxel at `lo` that spheres fill, each counted for itself."""
    axis = (np.arange(POINTS) + 0.5) / POINTS * VOXEL
    share = 0.0
    for x, y, z, r in grains:
        squared = ((lo[0] + axis - x)**2)[:, None, None] + ((lo[1] + axis - y)**2)[None, :, None] \
            + ((lo[2] + axis - z)**2)[None, None, :]
        share += np.count_nonzero(squared < r * r) / POINTS**3
    return share


def main():
    command, sample = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([command, "voids", sample, "-o", folder + "/out", "--voxel", "15um", "--no-figures",
                        "--average", "60um", "--quiet"], check=True, stdout=subprocess.DEVNULL)
        stem = sample.split("/")[-1].rsplit(".", 1)[0]
        grids, metadata = vdb.readAll(f"{folder}/out/{stem}/fields.vdb")
    by_name = {grid.name: grid for grid in grids}
    solid, void = by_name["solid_fraction"], by_name["void_fraction"]
    assert {"solid_fraction_averaged", "void_fraction_averaged"} <= set(by_name), list(by_name)

    columns = last_frame(sample)
    grains = np.stack([columns[c] for c in ("x", "y", "z", "radius")], axis=1)
    corner = np.array([float(v) for v in metadata["box"].split(",")])[0::2]  # x0,x1,y0,y1,z0,z1

    # an integer index is a voxel's centre, in metres
    for index in ((0, 0, 0), (7, 3, 5)):
        world = np.array(solid.transform.indexToWorld(index))
        assert np.allclose(world, corner + (np.array(index) + 0.5) * VOXEL, rtol=0, atol=1e-12), (index, world)

    # the sum over voxels is the grains' volume, as far as floats hold it
    total = sum(float(item.value) * item.count for item in solid.iterOnValues()) * VOXEL**3
    truth = 4 * np.pi / 3 * np.sum(grains[:, 3]**3)
    assert abs(total / truth - 1) < 1e-6, (total, truth)

    # voxels one by one
    worst, looked_at = 0.0, 0
    shares, voids = solid.getConstAccessor(), void.getConstAccessor()
    generator = np.random.default_rng(1)
    for item in solid.iterOnValues():
        if item.count != 1 or generator.random() > 0.02:
            continue
        lo = corner + np.array(item.min) * VOXEL
        near = grains[np.all(np.abs(grains[:, :3] - (lo + VOXEL / 2)) < grains[:, 3:] + VOXEL, axis=1)]
        worst = max(worst, abs(shares.getValue(item.min) - sampled_share(lo, near)))
        assert abs(shares.getValue(item.min) + voids.getValue(item.min) - 1) < 2e-7
        looked_at += 1
    assert looked_at > 50, looked_at
    assert worst < 1e-2, worst
    print(f"{looked_at} voxels within {worst:.1e} of sampling; volume within {abs(total / truth - 1):.1e}")


main()
