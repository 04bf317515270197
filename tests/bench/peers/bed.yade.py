# The bed of bed.liggghts in YADE, Hertz and Mindlin with friction and restitution, no rolling friction, no cohesion.
# Environment: BED (text dump: id x y z radius), STEPS, DT. Prints "Loop time of SECONDS" for three blocks.
import os, sys, time
from yade import O, utils
lines = open(os.environ['BED']).read().split('\n')
edges = [float(lines[i].split()[1]) for i in (5, 6, 7)]
powder = O.materials.append(FrictMat(young=1e9, poisson=0.3, density=8200, frictionAngle=0.29146))  # atan 0.3
floor = O.materials.append(FrictMat(young=1e9, poisson=0.3, density=8200, frictionAngle=0.7328))  # atan 0.9
O.periodic = True
O.cell.setBox(edges[0], edges[1], 2 * edges[2])
for line in lines[9:]:
    w = line.split()
    if w:
        O.bodies.append(utils.sphere([float(v) for v in w[1:4]], float(w[4]), material=powder))
O.bodies.append(utils.wall(0, axis=2, sense=1, material=floor))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=2e-6, allowBiggerThanPeriod=True),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.35, es=0.35)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.81))]
O.dt = float(os.environ['DT'])
steps = int(os.environ['STEPS'])
O.run(20, True)
for block in range(3):
    start = time.time()
    O.run(steps, True)
    print('Loop time of %.6f' % (time.time() - start))
print('coordination %.2f' % (2.0 * sum(1 for i in O.interactions if i.isReal) / (len(O.bodies) - 1)))
sys.stdout.flush()
os._exit(0)
