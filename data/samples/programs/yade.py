# YADE 2023.02a: the same grains through its own exports; run by `yade -n -x yade.py`.
from yade import export
exec(open('grains.py').read())
material = O.materials.append(FrictMat(density=7800, young=1e9, poisson=0.3, frictionAngle=0.3))
for x, y, z, r in grains:
    O.bodies.append(sphere((x, y, z), r, material=material))
export.text('yade.txt')
export.textExt('yade-mass.txt', format='x_y_z_r_matId', comment='grains at rest')
exporter = export.VTKExporter('yade')
exporter.exportSpheres(what={'id': 'b.id'})
O.dt = 1e-9
O.engines = [VTKRecorder(fileName='yade-', recorders=['spheres', 'velocity'], iterPeriod=1)]
O.step()
