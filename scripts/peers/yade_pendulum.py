"""The triple pendulum in the packaged YADE: run by `yade -j1 -x -n`; states at some steps as hexfloats, JSON.

Written from YADE's documented Python interface and the paper's description of the scene; see scripts/peers/compare_yade.py.
"""

import json
import math
import os
import time

steps = [int(x) for x in os.environ["PEER_STEPS"].split(",")]
length, inclination = 0.1, 20 * math.pi / 180
radius = length / 100

material = O.materials.append(
    CohFrictMat(
        young=1e5,
        poisson=0.0,
        density=10,
        frictionAngle=0.0,
        normalCohesion=1e13,
        shearCohesion=1e13,
        momentRotationLaw=False,
    )
)
for i in range(4):
    centre = [
        ((i * length) / 4) * math.cos(inclination),
        ((i * length) / 4) * math.sin(inclination),
        0,
    ]
    O.bodies.append(sphere(centre, radius, material=material, fixed=(i == 0)))
O.engines = [
    ForceResetter(),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D()],
        [
            Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(
                setCohesionNow=True, setCohesionOnNewContacts=True
            )
        ],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()],
    ),
    NewtonIntegrator(damping=float(os.environ["PEER_DAMPING"]), gravity=(0, -9.81, 0)),
]
O.dt = float(os.environ["PEER_DT"])
for first, second in ((0, 1), (1, 2), (2, 3)):
    bond = createInteraction(first, second)
    d = O.bodies[second].state.pos - O.bodies[first].state.pos
    rest = math.sqrt(d[0] * d[0] + d[1] * d[1])
    bond.phys.unp = -rest + radius + radius

states, seconds, now = {}, 0.0, 0
for step in sorted(steps):
    start = time.perf_counter()
    O.run(step - now, True)
    seconds += time.perf_counter() - start
    now = step
    states[step] = [
        [
            float(x).hex()
            for x in (
                b.state.pos[0],
                b.state.pos[1],
                b.state.vel[0],
                b.state.vel[1],
            )
        ]
        for b in O.bodies
        if b.id != 0
    ]
with open(os.environ["PEER_OUT"], "w") as out:
    json.dump(
        {
            "states": states,
            "mass": float(O.bodies[1].state.mass).hex(),
            "seconds": seconds,
        },
        out,
    )
