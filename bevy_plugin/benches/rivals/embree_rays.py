"""Traces the rays that `bake --dump-rays` wrote with Embree on one thread.

usage: embree_rays.py DIR RAYS [REPEATS]

DIR is what was baked: its scene.glb gives the triangles, its report.json the number of rays of the whole bake. RAYS
holds records of eight little-endian f32: origin, direction, end, and 0 for the closest hit or 1 for any. Prints JSON:
for each kind the rays, hits, seconds (the best of REPEATS, 3) and million rays per second, and `scaled`: what Embree
would take for all rays of the bake.

Needs numpy and embreex of PyPI.
"""

import json
import struct
import sys
import time

import numpy as np
from embreex import mesh_construction, rtcore_scene

TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
NUMBERS = {"SCALAR": 1, "VEC3": 3}
TRIANGLES = 4


class Glb:
    """A binary glTF file."""

    def __init__(self, path):
        data = open(path, "rb").read()
        (length,) = struct.unpack_from("<I", data, 12)
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[20 + length + 8 :]

    def accessor(self, index):
        """The numbers of an accessor, one row for each element."""
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind = np.dtype(TYPES[accessor["componentType"]])
        shape = (accessor["count"], NUMBERS[accessor["type"]])
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", kind.itemsize * shape[1])
        return np.ndarray(shape, kind, self.binary, start, (stride, kind.itemsize))

    def triangles(self):
        """The corners of all triangles of the scene, in world space."""
        scene = self.json["scenes"][self.json.get("scene", 0)]
        found = [part for node in scene["nodes"] for part in self.below(node, np.eye(4))]
        return np.ascontiguousarray(np.concatenate(found), np.float32)

    def below(self, index, parent):
        """The triangles of a node and of its children."""
        node = self.json["nodes"][index]
        world = parent @ matrix(node)
        primitives = self.json["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []
        for primitive in primitives:
            if primitive.get("mode", TRIANGLES) == TRIANGLES:
                points = self.accessor(primitive["attributes"]["POSITION"]) @ world[:3, :3].T + world[:3, 3]
                yield (points[self.accessor(primitive["indices"])[:, 0]] if "indices" in primitive else points).reshape(-1, 3, 3)
        for child in node.get("children", []):
            yield from self.below(child, world)


def matrix(node):
    """The transform of a node."""
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    result = np.eye(4)
    result[:3, :3] = rotation * np.array(node.get("scale", (1, 1, 1)))
    result[:3, 3] = node.get("translation", (0, 0, 0))
    return result


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
    triangles = Glb(f"{folder}/scene.glb").triangles()
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
