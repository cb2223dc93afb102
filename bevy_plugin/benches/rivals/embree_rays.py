"""Traces the rays that `bake --dump-rays` wrote with Embree on one thread.

usage: embree_rays.py DIR RAYS [REPEATS]

DIR is what was baked: its scene.glb gives the triangles, its report.json the number of rays of the whole bake. RAYS
holds records of eight little-endian f32: origin, direction, end, and 0 for the closest hit or 1 for any. Prints JSON:
for each kind the rays, hits, seconds (the best of REPEATS, 3) and million rays per second, and `scaled`: what Embree
would take for all rays of the bake.

Needs numpy and embreex of PyPI.
"""

import json
import sys
import time

import numpy as np
from embreex import mesh_construction, rtcore_scene

import glb


def trace(scene, rays, query, repeats):
    """What Embree takes for some rays."""
    origins, directions = np.ascontiguousarray(rays[:, 0:3]), np.ascontiguousarray(rays[:, 3:6])
    ends = np.ascontiguousarray(rays[:, 6])
    best, hits = float("inf"), 0
    for _ in range(repeats if len(rays) else 0):
        start = time.process_time()
        found = scene.run(origins, directions, dists=ends, query=query)
        best = min(best, time.process_time() - start)
        hits = int((found != -1).sum())
    seconds = best if len(rays) else 0.0
    return {"rays": len(rays), "hits": hits, "seconds": seconds, "mray_per_second": len(rays) / max(seconds, 1e-9) / 1e6}


def main(folder, dump, repeats=3):
    rays = np.fromfile(dump, "<f4").reshape(-1, 8)
    surfaces, _ = glb.read(f"{folder}/scene.glb")
    triangles = np.concatenate([surface.corners() for surface in surfaces]).astype(np.float32)
    scene = rtcore_scene.EmbreeScene()
    mesh_construction.TriangleMesh(scene, triangles)
    # The first query builds the tree.
    scene.run(rays[:1, 0:3].copy(), rays[:1, 3:6].copy())
    closest = trace(scene, rays[rays[:, 7] == 0], "INTERSECT", int(repeats))
    any_hit = trace(scene, rays[rays[:, 7] == 1], "OCCLUDED", int(repeats))
    stages = json.load(open(f"{folder}/report.json"))["stages"]
    total = sum(stage["rays"] for stage in stages)
    seconds = (closest["seconds"] + any_hit["seconds"]) * total / max(len(rays), 1)
    scaled = {"rays": total, "seconds": seconds}
    print(json.dumps({"triangles": len(triangles), "closest": closest, "any": any_hit, "scaled": scaled}, indent=2))


if __name__ == "__main__":
    main(*sys.argv[1:])
