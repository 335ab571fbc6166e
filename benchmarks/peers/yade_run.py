"""Runs a case in YADE, which executes this file: it reads case.json in the present folder, as yade_contestant.cc writes it, and
either writes a track of the beads' places or prints the seconds that some steps take."""

import json
import time

with open("case.json") as file:
    case = json.load(file)

for properties in case["materials"]["list"]:
    O.materials.append(FrictMat(young=properties["young"], poisson=properties["poisson"],
                                density=properties["density"]))


def by_pair(name):
    return MatchMaker(matches=tuple((*pair["materials"], pair[name]) for pair in case["materials"]["pairs"]))


from yade import ymport

facets = O.bodies.append(ymport.stl(case["vessel"], material=O.materials[case["vessel_material"]]))
id_of = {}
for bead in case["beads"]:
    body = sphere(bead["position"], bead["radius"], material=bead["material"])
    body.state.vel = bead["velocity"]
    body.state.angVel = bead["spin"]
    id_of[O.bodies.append(body)] = bead["id"]

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=case["distance"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(hertzian=True)],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(frictAngle=by_pair("friction_angle"),
                                                       betan=by_pair("damping_ratio"), betas=0.0)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=case["gravity"]),
]
if case["vessel_spin"] != 0:
    O.engines += [RotationEngine(rotateAroundZero=True, zeroPoint=(0, 0, 0), rotationAxis=(0, 1, 0),
                                 angularVelocity=case["vessel_spin"], ids=facets)]
O.dt = case["time_step"]
O.dynDt = False


def take_out():
    gone = [body for body in id_of if O.bodies[body].state.pos[2] < case["outlet"]]
    for body in gone:
        O.bodies.erase(body)
        del id_of[body]


def write_track(job):
    only = job.get("only_bead")
    watched = {body: bead for body, bead in id_of.items() if only is None or bead == only}
    with open(job["track"], "w") as track:
        for sample in range(job["samples"] + 1):
            if sample > 0:
                O.run(job["steps_between_samples"], True)
            if "outlet" in case:
                take_out()
            rows = [(bead, O.bodies[body].state.pos) for body, bead in watched.items() if body in id_of]
            track.write(f"ITEM: TIMESTEP\n{O.iter}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: ATOMS id x y z\n")
            for bead, x in rows:
                track.write(f"{bead} {x[0]!r} {x[1]!r} {x[2]!r}\n")


job = case["job"]
if "track" in job:
    write_track(job)
else:
    O.run(job["warm_up_steps"], True)
    start = time.perf_counter()
    O.run(job["timed_steps"], True)
    print(f"seconds of the steps: {time.perf_counter() - start}")
