"""The gravity deposition in the packaged YADE: run by `yade -jN -x -n`; its speed and a few facts as JSON.

Written from YADE's documented Python interface and the scene's published numbers; see scripts/peers/compare_yade.py.
"""

import json
import math
import os
import time

steps = int(os.environ["PEER_STEPS"])
radius = 0.5 / 30.77
gap = 0.5 * radius
a = 2 * radius + gap
material = O.materials.append(
    ViscElMat(density=2300, frictionAngle=math.radians(35), tc=1e-3, en=3e-3, et=3e-3)
)
count = int(2 / a) + 2
for i in range(count):
    for j in range(count):
        for k in range(count):
            x = a / 2 * (2 * i + (j + k) % 2) - 0.5
            y = a / 2 * math.sqrt(3) * (j + (k % 2) / 3) - 0.5
            z = a / 2 * 2 * math.sqrt(6) / 3 * k - 0.5
            if math.sqrt(x * x + y * y + z * z) + radius <= 0.5:
                O.bodies.append(sphere([x, y, z], radius, material=material))
spheres = len(O.bodies)
O.bodies.append(
    geom.facetBox(
        (-0.002356191095, -0.001596798006, -0.002459834501),
        (0.51826048, 0.50344496, 0.50465144),
        material=material,
    )
)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    NewtonIntegrator(damping=0, gravity=(0, -9.81, 0)),
]
O.dt = 1e-4
O.run(1, True)
start = time.perf_counter()
O.run(steps, True)
seconds = time.perf_counter() - start
heights = [b.state.pos[1] for b in O.bodies if isinstance(b.shape, Sphere)]
with open(os.environ["PEER_OUT"], "w") as out:
    json.dump(
        {
            "spheres": spheres,
            "iterations_per_s": steps / seconds,
            "kinetic_energy": float(utils.kineticEnergy()),
            "mean_y": float(sum(heights) / len(heights)),
        },
        out,
    )
