#!/usr/bin/env python3
"""Makes the sample particle files of this folder (Python's standard library only): python3 make_samples.py

150 grains of 20 to 65 um, placed at random without overlap in a box of 1 x 0.5 x 0.4 mm; a second frame in which each
grain has sunk by 5 % of its height. The same grains in every file."""
import gzip
import random

BOX = (1.0e-3, 0.5e-3, 0.4e-3)
COUNT = 150


def grains(seed=20):
    rng = random.Random(seed)
    placed = []
    while len(placed) < COUNT:
        d = float("%.4g" % (1e-6 * rng.uniform(20, 65)))
        p = [float("%.7g" % rng.uniform(d / 2, edge - d / 2)) for edge in BOX]
        if all(sum((a - b) ** 2 for a, b in zip(p, q)) >= ((d + e) / 2) ** 2 for q, e in placed):
            placed.append((p, d))
    return placed


def dump(frames):
    """Rows in a shuffled order and columns in an unusual one, as simulations write them."""
    rng = random.Random(5)
    text = ""
    for step, frame in frames:
        text += "ITEM: TIMESTEP\n%d\nITEM: NUMBER OF ATOMS\n%d\n" % (step, len(frame))
        text += "ITEM: BOX BOUNDS ff ff ff\n" + "".join("0 %.9g\n" % edge for edge in BOX)
        text += "ITEM: ATOMS vz type radius z id x y density\n"
        rows = list(enumerate(frame, 1))
        rng.shuffle(rows)
        for i, ((x, y, z), d) in rows:
            text += "0 1 %.9g %.9g %d %.9g %.9g 7800\n" % (d / 2, z, i, x, y)
    return text


def main():
    first = grains()
    second = [((x, y, d / 2 + 0.95 * (z - d / 2)), d) for (x, y, z), d in first]
    text = dump([(1000, first), (2000, second)])
    with open("two-frames.dump", "w") as f:
        f.write(text)
    with open("two-frames-gz.dump.gz", "wb") as f, gzip.GzipFile("", "wb", 9, f, mtime=0) as z:
        z.write(text.encode())
    with open("micrometres.csv", "w") as f:
        f.write("x [um],y [um],z [um],diameter [um]\n")
        for (x, y, z), d in first:
            f.write("%.9g,%.9g,%.9g,%.9g\n" % (1e6 * x, 1e6 * y, 1e6 * z, 1e6 * d))
    with open("yade.txt", "w") as f:
        f.write("#format x_y_z_r\n")
        for (x, y, z), d in first:
            f.write("%.9g\t%.9g\t%.9g\t%.9g\n" % (x, y, z, d / 2))


main()
