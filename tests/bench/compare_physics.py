#!/usr/bin/env python3
"""The same grains fall on the same floor in this engine and in LIGGGHTS, and come to rest: are the beds alike?

    compare_physics.py INTERSTICE [SEEDS]     needs liggghts and h5dump (Debian: liggghts, hdf5-tools)

2,000 grains (normal, mean 39.4 um, sd 10.46 um, 20 to 65 um) at random places without overlap, 30 % solid, periodic sides, 20 ms in steps of
200 ns; with SJKR and without. Every contact is chaotic in time, so single grains end elsewhere; what is compared are means over beds of several
seeds (at least 4). Contacts and forces are worked out here, from the positions that both codes leave, by the laws they both claim: overlap,
Hertz, SJKR. Prints a table; a difference within 3 standard errors of the two means counts as agreement.
"""
import math
import os
import random
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

EDGE, GRAINS, SOLID, STEPS, DT = 0.5e-3, 2000, 0.30, 100000, 2e-7  # [m], -, -, -, [s]
DENSITY, YOUNG, POISSON, COHESION, GRAVITY = 8200.0, 1e7, 0.3, 46.4e3, 9.81
EFFECTIVE = YOUNG / (2 * (1 - POISSON**2))
HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'peers')


class Cells:
    """Grains by cells wider than the largest, to find those near a place; periodic along x and y."""

    def __init__(self, largest):
        self.n = int(EDGE / largest)
        self.width = EDGE / self.n
        self.grains = {}

    def key(self, x, y, z):
        return int(x / self.width) % self.n, int(y / self.width) % self.n, math.floor(z / self.width)

    def add(self, i, x, y, z):
        self.grains.setdefault(self.key(x, y, z), []).append(i)

    def near(self, x, y, z):
        a, b, c = self.key(x, y, z)
        for i in (-1, 0, 1):
            for j in (-1, 0, 1):
                for k in (-1, 0, 1):
                    yield from self.grains.get(((a + i) % self.n, (b + j) % self.n, c + k), ())


def distance(p, q):
    dx, dy = p[0] - q[0], p[1] - q[1]
    dx -= EDGE * round(dx / EDGE)
    dy -= EDGE * round(dy / EDGE)
    return math.sqrt(dx * dx + dy * dy + (p[2] - q[2])**2)


def start(seed):
    """Rows (x, y, z, radius) [m], largest first placed, at random places without overlap."""
    rng = random.Random(seed)
    radii = []
    while len(radii) < GRAINS:
        d = rng.gauss(39.4e-6, 10.46e-6)
        if 20e-6 <= d <= 65e-6:
            radii.append(d / 2)
    radii.sort(reverse=True)
    height = sum(4 / 3 * math.pi * r**3 for r in radii) / (SOLID * EDGE**2)
    cells, rows = Cells(2.02 * radii[0]), []
    for r in radii:
        while True:
            p = (rng.uniform(0, EDGE), rng.uniform(0, EDGE), rng.uniform(1.01 * r, height))
            if all(distance(p, rows[j]) > 1.01 * (r + rows[j][3]) for j in cells.near(*p)):
                break
        cells.add(len(rows), *p)
        rows.append((*p, r))
    return rows


def write_starts(rows):
    with open('box.csv', 'w') as out:
        out.write('x [m], y [m], z [m], diameter [m]\n')
        for x, y, z, r in rows:
            out.write(f'{x!r},{y!r},{z!r},{2 * r!r}\n')
    with open('box.data', 'w') as out:
        out.write(f'grains\n\n{len(rows)} atoms\n2 atom types\n0 {EDGE} xlo xhi\n0 {EDGE} ylo yhi\n-5e-06 2e-3 zlo zhi\n\nAtoms\n\n')
        for i, (x, y, z, r) in enumerate(rows):
            out.write(f'{i + 1} 1 {2 * r!r} {DENSITY} {x!r} {y!r} {z!r}\n')


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f'{" ".join(command[:3])} failed:\n' + '\n'.join(done.stdout.split('\n')[-8:]))
    return done.stdout


def run_theirs(cohesion):
    laws = 'cohesion sjkr ' if cohesion else ''
    variables = {'px': 1, 'steps': STEPS, 'dt': DT, 'E': YOUNG, 'k': COHESION,
                 'model': f'hertz tangential history {laws}rolling_friction cdt'}
    run(['liggghts', '-in', 'box.liggghts', '-log', 'none'] + [w for k, v in variables.items() for w in ('-var', k, str(v))])


def run_ours(command, cohesion):
    scene = open('box.toml').read()
    if not cohesion:
        scene = re.sub(r'^cohesion.*\n', '', scene, flags=re.M)
    with open('scene.toml', 'w') as out:
        out.write(scene)
    run([command, 'run', 'scene.toml', '-o', 'out', '--overwrite', '--no-figures', '--quiet', '--threads', '1'])
    last = run(['h5ls', 'out/trajectory.h5part']).count('Step#') - 1
    columns = [[float(v) for v in re.findall(r'[-+0-9.e]+', run(
        ['h5dump', '-y', '-w', '1', '-m', '%.17g', '-d', f'/Step#{last}/{name}', 'out/trajectory.h5part']).split('DATA {')[1].split('}')[0])]
        for name in ('x', 'y', 'z', 'radius')]
    with open('ours.dump', 'w') as out:
        out.write(f'ITEM: TIMESTEP\n{STEPS}\nITEM: NUMBER OF ATOMS\n{len(columns[0])}\nITEM: BOX BOUNDS pp pp ff\n'
                  f'0 {EDGE}\n0 {EDGE}\n-1e-4 2e-3\nITEM: ATOMS id x y z radius\n')
        for i, row in enumerate(zip(*columns)):
            out.write(f'{i + 1} ' + ' '.join(repr(v) for v in row) + '\n')


def rows_of(dump):
    text = open(dump).read().split('ITEM: ATOMS')[-1].split('\n')[1:]
    return [tuple(float(v) for v in line.split()[1:5]) for line in text if line.strip()]


def elastic(overlap, radius):
    return 4 / 3 * EFFECTIVE * math.sqrt(radius) * overlap**1.5


def numbers(command, dump, cohesion):
    """What a bed is like, in the order of NAMES."""
    rows = rows_of(dump)
    cells = Cells(2.02 * max(r for *_, r in rows))
    touches, forces = [0] * len(rows), []
    for i, p in enumerate(rows):
        for j in cells.near(*p[:3]):
            q = rows[j]
            overlap = p[3] + q[3] - distance(p, q)
            if overlap > 0:
                touches[i] += 1
                touches[j] += 1
                forces.append(elastic(overlap, p[3] * q[3] / (p[3] + q[3])))
        cells.add(i, *p[:3])
    coordination = sum(touches) / len(rows)
    floor = 0
    for i, (x, y, z, r) in enumerate(rows):
        if z < r:
            touches[i] += 1
            floor += elastic(r - z, r) - (COHESION * math.pi * (r * r - z * z) if cohesion else 0)
    weight = sum(4 / 3 * math.pi * r**3 for *_, r in rows) * DENSITY * GRAVITY
    run([command, 'voids', dump, '-o', 'voids', '--overwrite', '--no-figures', '--quiet', '--voxel', '20um', '--periodic', 'xy',
         '--box', '0um,500um,0um,500um,100um,400um'])
    summary = open(os.path.join('voids', os.path.splitext(dump)[0], 'summary.json')).read()
    void = float(re.search(r'"void_fraction_mean": ([0-9.e-]+)', summary).group(1))
    mean = statistics.fmean(forces)
    return [1 - void, coordination, sum(t < 3 for t in touches) / len(rows), mean * 1e9, statistics.pstdev(forces) / mean,
            sorted(forces)[int(0.9 * len(forces))] / mean, floor / weight]


NAMES = ['solid fraction, 100 to 400 um', 'coordination', 'grains with fewer than 3 contacts', 'elastic normal force, mean [nN]',
         '... sd / mean', '... 90th percentile / mean', 'load on the floor / weight']


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    command = os.path.abspath(sys.argv[1])
    seeds = range(1, 1 + (int(sys.argv[2]) if len(sys.argv) > 2 else 4))
    for needed in ('liggghts', 'h5dump', 'h5ls'):
        if not shutil.which(needed):
            sys.exit(f'{needed} is not installed (Debian: liggghts, hdf5-tools)')
    print(run([command, '--version']).split('\n')[0] + ' and LIGGGHTS', f'{GRAINS} grains, {len(seeds)} seeds: mean (sd over seeds)', sep='\n')
    with tempfile.TemporaryDirectory() as work:
        for file in os.listdir(HERE):
            shutil.copy(os.path.join(HERE, file), work)
        os.chdir(work)
        for cohesion in (False, True):
            ours, theirs = [], []
            for seed in seeds:
                write_starts(start(seed))
                run_ours(command, cohesion)
                run_theirs(cohesion)
                ours.append(numbers(command, 'ours.dump', cohesion))
                theirs.append(numbers(command, 'theirs.dump', cohesion))
            report('SJKR' if cohesion else 'no cohesion', ours, theirs)


def report(title, ours, theirs):
    print(f'\n| {title} | interstice | LIGGGHTS | difference in standard errors | |\n|---|---|---|---|---|')
    for name, a, b in zip(NAMES, zip(*ours), zip(*theirs)):
        error = math.sqrt((statistics.variance(a) + statistics.variance(b)) / len(a))
        apart = (statistics.fmean(a) - statistics.fmean(b)) / error if error > 0 else 0
        print('| {} | {:.4g} ({:.2g}) | {:.4g} ({:.2g}) | {:+.1f} | {} |'.format(
            name, statistics.fmean(a), statistics.stdev(a), statistics.fmean(b), statistics.stdev(b), apart,
            'agree' if abs(apart) < 3 else 'differ'), flush=True)


if __name__ == '__main__':
    main()
