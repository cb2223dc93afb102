"""Error of a baked lightmap, sampled bilinearly as the GPU does, against irradiance / pi at points of the surfaces.

usage: error.py BAKED_DIR REFERENCE.csv

BAKED_DIR holds scene.glb, manifest.json, and lightmap-K.exr or lightmap-K.npy. An error is |baked - true| /
(true + a tenth of the mean), so that neither a hot spot nor a black corner decides alone. Prints one line of JSON:

rms         root mean square over points and channels, less the noise that the reference itself has
noise       what was taken off: root mean square of the reference's standard error
rms_error   standard error of rms, by drawing the points anew
p50, p95    quantiles of the mean magnitude over the channels
bias        mean signed error over the mean
points, missing   compared ones, and those without a texel
"""

import csv
import json
import os
import sys

import numpy as np

import glb

INSIDE = 0.1


def reference(path):
    """Positions, normals, light and its standard error; without points inside geometry."""
    with open(path) as file:
        rows = [row for row in csv.DictReader(file) if float(row.get("back") or 0) <= INSIDE]
    table = lambda *names: np.array([[float(row[name]) for name in names] for row in rows])
    return table("x", "y", "z"), table("nx", "ny", "nz"), table("r", "g", "b"), table("se_r", "se_g", "se_b")


class Lightmaps:
    """Where on the images each triangle finds its light."""

    def __init__(self, folder):
        manifest = json.load(open(f"{folder}/manifest.json"))
        surfaces, _ = glb.read(f"{folder}/scene.glb")
        self.images = [image(folder, k, entry) for k, entry in enumerate(manifest["images"])]
        places = {(entry["node"], entry["primitive"]): entry for entry in manifest["surfaces"]}
        lit = [(surface, places[key]) for surface in surfaces if (key := (surface.node, surface.primitive)) in places]
        self.corners = np.concatenate([surface.corners() for surface, _ in lit])
        self.uv = np.concatenate([in_image(surface.uv, place["uv_rect"])[surface.triangles] for surface, place in lit])
        self.owner = np.concatenate([np.full(len(surface.triangles), place["image"]) for surface, place in lit])
        self.ab, self.ac = self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]
        self.normals = glb.normalized(np.cross(self.ab, self.ac))
        self.extent = glb.extent(surfaces)

    def light(self, position, normal):
        """What the GPU shows at a point, or nothing where no triangle with a lightmap lies."""
        height = np.abs(((position - self.corners[:, 0]) * self.normals).sum(1))
        near = np.nonzero((height < 1e-4 * self.extent) & (self.normals @ normal > 0.99))[0]
        bary = barycentric(position - self.corners[near, 0], self.ab[near], self.ac[near])
        if len(near) == 0 or (best := np.argmax(bary.min(1))) is None or bary[best].min() < -1e-3:
            return None
        return bilinear(self.images[self.owner[near[best]]], bary[best] @ self.uv[near[best]])


def in_image(uv, rectangle):
    low, high = np.array(rectangle[:2]), np.array(rectangle[2:])
    return low + uv * (high - low)


def barycentric(offset, ab, ac):
    """Of points given from the first corner, for each of many triangles; degenerate ones contain nothing."""
    dot = lambda a, b: (a * b).sum(1)
    bb, bc, cc, pb, pc = dot(ab, ab), dot(ab, ac), dot(ac, ac), dot(offset, ab), dot(offset, ac)
    area = bb * cc - bc * bc
    safe = np.where(area > 0, area, 1)
    b, c = (cc * pb - bc * pc) / safe, (bb * pc - bc * pb) / safe
    return np.where((area > 0)[:, None], np.stack([1 - b - c, b, c], 1), -1)


def bilinear(texels, uv):
    size = np.array(texels.shape[1::-1])
    place = np.clip(uv * size - 0.5, 0, size - 1)
    (x, y), (s, t) = place.astype(int), place % 1
    right, below = np.minimum([x + 1, y + 1], size - 1)
    above = texels[y, x] * (1 - s) + texels[y, right] * s
    return above * (1 - t) + (texels[below, x] * (1 - s) + texels[below, right] * s) * t


def image(folder, k, entry):
    """Rows from the top, three channels."""
    plain = f"{folder}/lightmap-{k}.npy"
    if os.path.exists(plain):
        return np.load(plain)
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    bitmap = mi.Bitmap(f"{folder}/{entry['exr']}")
    return np.array(bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))


def summary(found, true, noise):
    """All figures for the light that was found at points, against the true one with its standard error."""
    mean = true.mean()
    scale = true + 0.1 * mean
    relative, own = (found - true) / scale, noise / scale
    magnitude = np.abs(relative).mean(1)
    squares = (relative**2 - own**2).mean(1)
    rms = lambda squares: float(np.sqrt(max(squares.mean(), 0)))
    rng = np.random.default_rng(1)
    again = [rms(squares[rng.integers(len(squares), size=len(squares))]) for _ in range(400)]
    return {
        "rms": rms(squares),
        "rms_error": float(np.std(again)),
        "noise": float(np.sqrt((own**2).mean())),
        "p50": float(np.quantile(magnitude, 0.5)),
        "p95": float(np.quantile(magnitude, 0.95)),
        "bias": float((found - true).mean() / mean),
    }


def compare(folder, table):
    lightmaps = Lightmaps(folder)
    positions, normals, true, noise = reference(table)
    found = [lightmaps.light(position, normal) for position, normal in zip(positions, normals)]
    has = np.array([light is not None for light in found])
    figures = summary(np.array([light for light in found if light is not None]), true[has], noise[has])
    return figures | {"points": int(has.sum()), "missing": int((~has).sum())}


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(json.dumps(compare(*sys.argv[1:])))
