"""Irradiance / pi at random points of a scene, by the path tracer of Mitsuba 3.

usage: truth.py SCENE.glb OUT.csv [--points N] [--seconds S] [--seed N]

Light adds up, so that of emissive surfaces and that of lamps are found apart, each in the way that leaves little noise:
emissive surfaces by looking at the point, (radiance - emission) / reflectance, where the path tracer samples them; lamps
straight by the formula and shadow rays, and over other surfaces by paths that leave the point with the density of the
cosine. A sun is a disc of 0.53 degrees in the direct part and a direction in the rest.

Each row: position, normal of the triangle, name, triangle, barycentric coordinates, irradiance / pi, its standard error,
and how much of what the point sees are backs of one-sided surfaces: above a tenth it lies inside geometry.
"""

import argparse
import csv
import glob
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import glb

COLUMNS = "x y z nx ny nz mesh triangle b0 b1 b2 r g b se_r se_g se_b back".split()
SUN_RADIUS = np.radians(0.53 / 2)
SUN_RAYS = 256
# Paths of one batch; the standard error is that of the means of batches.
BATCH = 1 << 17
LEAST_BATCHES = 16


def name_llvm():
    """Mitsuba compiles its kernels by LLVM, of which every Rust toolchain on Linux has a shared library."""
    if "DRJIT_LIBLLVM_PATH" in os.environ:
        return
    try:
        sysroot = subprocess.run(["rustc", "--print", "sysroot"], capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        sysroot = "/nonexistent"
    found = glob.glob(f"{sysroot}/lib/libLLVM*") + glob.glob("/usr/lib/llvm-19/lib/libLLVM*.so*")
    if found:
        # Beside the library lie short files that only a linker reads.
        os.environ["DRJIT_LIBLLVM_PATH"] = max(found, key=os.path.getsize)


name_llvm()
import mitsuba as mi  # noqa: E402  (LLVM is looked for when it is imported)

try:
    mi.set_variant("llvm_ad_rgb")
    import drjit as dr

    dr.eval(mi.Float(1) + 1)
except Exception as error:  # noqa: BLE001  (Dr.Jit raises several kinds)
    sys.exit(f"Mitsuba finds no LLVM: {error}\nInstall libllvm19 or newer, or name its library in DRJIT_LIBLLVM_PATH.")


class Points:
    """Random points, uniform by area, on surfaces that reflect."""

    def __init__(self, surfaces, count, seed):
        rng = np.random.default_rng(seed)
        lit = [surface for surface in surfaces if surface.reflectance.min() > 0.02]
        owners = [(surface, k) for surface in lit for k in range(len(surface.triangles))]
        areas = [np.linalg.norm(np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]), axis=1) for c in map(glb.Surface.corners, lit)]
        areas = np.concatenate(areas)
        chosen = rng.choice(len(owners), count, p=areas / areas.sum())
        u, v = rng.random((2, count))
        root = np.sqrt(u)
        self.bary = np.stack([1 - root, root * (1 - v), root * v], 1)
        self.owners = [owners[index] for index in chosen]
        corners = np.array([surface.positions[surface.triangles[k]] for surface, k in self.owners])
        self.positions = (self.bary[:, :, None] * corners).sum(1)
        self.flat = glb.normalized(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        self.normals = np.array([self.shading_normal(index) for index in range(count)])
        self.reflectance = np.array([surface.reflectance for surface, _ in self.owners])
        self.emission = np.array([surface.emission for surface, _ in self.owners])
        self.starts = self.positions + self.flat * 1e-4 * glb.extent(surfaces)

    def shading_normal(self, index):
        (surface, k), flat = self.owners[index], self.flat[index]
        if surface.smooth is None:
            return flat
        return glb.normalized(self.bary[index] @ surface.smooth[surface.triangles[k]])


def shape(surface, folder, index, emits):
    """A surface as Mitsuba takes it."""
    mesh = mi.Mesh(f"m{index}", len(surface.positions), len(surface.triangles), has_vertex_normals=surface.smooth is not None)
    parts = mi.traverse(mesh)
    parts["vertex_positions"] = surface.positions.astype(np.float32).ravel()
    parts["faces"] = surface.triangles.astype(np.uint32).ravel()
    if surface.smooth is not None:
        parts["vertex_normals"] = surface.smooth.astype(np.float32).ravel()
    parts.update()
    path = os.path.join(folder, f"{index}.ply")
    mesh.write_ply(path)
    matt = {"type": "diffuse", "reflectance": rgb(surface.reflectance)}
    bsdf = {"type": "twosided", "matt": matt} if surface.double_sided else matt
    description = {"type": "ply", "filename": path, "face_normals": surface.smooth is None, "bsdf": bsdf}
    if emits and surface.emission.max() > 0:
        if surface.double_sided:
            raise glb.Unsupported(f"{surface.name}: emission of both sides")
        description["emitter"] = {"type": "area", "radiance": rgb(surface.emission)}
    return description


def rgb(values):
    return {"type": "rgb", "value": [float(value) for value in values]}


def emitters(lamp):
    """A lamp as Mitsuba takes it; the smooth edge of a spot is a sum of cones with linear edges."""
    if lamp.kind == "point":
        return [{"type": "point", "position": lamp.position.tolist(), "intensity": rgb(lamp.strength)}]
    if lamp.kind == "directional":
        return [{"type": "directional", "direction": lamp.direction.tolist(), "irradiance": rgb(lamp.strength)}]
    inner, outer = np.arccos(lamp.cosines)
    angles = np.linspace(inner, outer, 9)
    shares = lamp.share(np.cos(angles))
    up = np.eye(3)[np.argmin(np.abs(lamp.direction))]
    target = lamp.position + lamp.direction
    place = mi.ScalarTransform4f().look_at(origin=lamp.position.tolist(), target=target.tolist(), up=up.tolist())
    cones = zip(angles[:-1], angles[1:], shares[:-1] - shares[1:])
    return [
        {"type": "spot", "intensity": rgb(lamp.strength * drop), "to_world": place}
        | {"beam_width": float(np.degrees(beam)), "cutoff_angle": float(np.degrees(max(cutoff, beam + 1e-5)))}
        for beam, cutoff, drop in cones
    ]


def load(surfaces, lamps):
    """A scene with the lamps, or where there are none with the emission of its surfaces."""
    with tempfile.TemporaryDirectory() as folder:
        description = {"type": "scene"}
        for index, surface in enumerate(surfaces):
            description[f"s{index}"] = shape(surface, folder, index, emits=not lamps)
        for index, emitter in enumerate(emitter for lamp in lamps for emitter in emitters(lamp)):
            description[f"l{index}"] = emitter
        return mi.load_dict(description)


def estimate(scene, points, seconds, seed, directions, value):
    """Mean and standard error of `value` of the radiance along random rays, for each point and channel."""
    count = len(points.positions)
    paths = max(1, BATCH // count)
    index = dr.repeat(dr.arange(mi.UInt32, count), paths)
    spread = lambda array: mi.Point3f(*[dr.gather(mi.Float, mi.Float(array[:, k].astype(np.float32)), index) for k in range(3)])
    starts, frames = spread(points.starts), mi.Frame3f(mi.Vector3f(spread(points.normals)))
    flat = mi.Vector3f(spread(points.flat))
    integrator = mi.load_dict({"type": "path", "max_depth": -1, "rr_depth": 8})
    means, end = [], time.monotonic() + seconds
    while len(means) < LEAST_BATCHES or time.monotonic() < end:
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(100_000 * seed + len(means), count * paths)
        ray = mi.RayDifferential3f(starts, directions(sampler, frames, flat))
        radiance = np.array(integrator.sample(scene, sampler, ray)[0], np.float64).reshape(3, count, paths).mean(2).T
        means.append(value(radiance))
    return np.mean(means, 0), np.std(means, 0, ddof=1) / np.sqrt(len(means)), len(means) * paths


def from_surfaces(surfaces, points, seconds, seed):
    """From emissive surfaces, over any number of bounces."""
    down = lambda sampler, frames, flat: -flat
    reflected = lambda radiance: (radiance - points.emission) / points.reflectance
    return estimate(load(surfaces, []), points, seconds, seed, down, reflected)


def from_lamps(surfaces, lamps, points, seconds, seed):
    """From lamps, over any number of bounces."""
    scene = load(surfaces, lamps)
    cosine = lambda sampler, frames, flat: frames.to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
    indirect, error, paths = estimate(scene, points, seconds, seed, cosine, lambda radiance: radiance)
    return indirect + sum(direct(scene, lamp, points) for lamp in lamps), error, paths


def direct(scene, lamp, points):
    """Irradiance / pi straight from a lamp."""
    if lamp.kind == "directional":
        axis = -lamp.direction
        u = glb.normalized(np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))]))
        v = np.cross(axis, u)
        k = np.arange(SUN_RAYS) + 0.5
        radius, angle = np.tan(SUN_RADIUS) * np.sqrt(k / SUN_RAYS), k * np.pi * (3 - np.sqrt(5))
        disc = axis + radius[:, None] * (np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * v)
        return sum(lit(scene, lamp.strength, points, d[None], 1e30, 1.0) for d in glb.normalized(disc)) / SUN_RAYS
    to_lamp = lamp.position - points.positions
    distance = np.linalg.norm(to_lamp, axis=1)
    toward = to_lamp / distance[:, None]
    return lit(scene, lamp.strength, points, toward, distance, lamp.share(-(toward @ lamp.direction)) / distance**2)


def lit(scene, strength, points, toward, distance, share):
    toward, distance = np.broadcast_to(toward, points.starts.shape), np.broadcast_to(distance, len(points.starts))
    ray = mi.Ray3f(mi.Point3f(*points.starts.T.astype(np.float32)), mi.Vector3f(*toward.T.astype(np.float32)))
    ray.maxt = mi.Float((distance * (1 - 1e-4)).astype(np.float32))
    seen = ~np.array(scene.ray_test(ray)) & ((toward * points.flat).sum(1) > 0)
    cosine = np.maximum((toward * points.normals).sum(1), 0)
    return (seen * share * cosine)[:, None] * strength / np.pi


def backs(surfaces, points):
    """The share of what each point sees that are backs of one-sided surfaces."""
    scene, count, rays = load([s for s in surfaces if not s.double_sided] or surfaces, []), len(points.positions), 256
    index = dr.repeat(dr.arange(mi.UInt32, count), rays)
    spread = lambda array: mi.Point3f(*[dr.gather(mi.Float, mi.Float(array[:, k].astype(np.float32)), index) for k in range(3)])
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(7, count * rays)
    direction = mi.Frame3f(mi.Vector3f(spread(points.flat))).to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
    hit = scene.ray_intersect(mi.Ray3f(spread(points.starts), direction))
    from_behind = hit.is_valid() & (dr.dot(hit.n, direction) > 0)
    return np.array(from_behind).reshape(count, rays).mean(1)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("scene")
    arguments.add_argument("out")
    arguments.add_argument("--points", type=int, default=350)
    arguments.add_argument("--seconds", type=float, default=60)
    arguments.add_argument("--seed", type=int, default=1)
    asked = arguments.parse_args()
    surfaces, lamps = glb.read(asked.scene)
    points = Points(surfaces, asked.points, asked.seed)
    emits = any(surface.emission.max() > 0 for surface in surfaces)
    seconds = asked.seconds / (2 if emits and lamps else 1)
    parts = [from_surfaces(surfaces, points, seconds, asked.seed)] if emits else []
    parts += [from_lamps(surfaces, lamps, points, seconds, asked.seed + 1)] if lamps else []
    if not parts:
        raise glb.Unsupported("the scene has no light")
    mean = sum(part[0] for part in parts)
    error = np.sqrt(sum(part[1] ** 2 for part in parts))
    behind = backs(surfaces, points)
    with open(asked.out, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        for i, (surface, triangle) in enumerate(points.owners):
            numbers = lambda values, digits: [f"{value:.{digits}g}" for value in values]
            place = numbers(points.positions[i], 7) + numbers(points.flat[i], 7)
            light = numbers(mean[i], 6) + numbers(error[i], 3) + [f"{behind[i]:.3f}"]
            writer.writerow([*place, surface.name, triangle, *numbers(points.bary[i], 6), *light])
    relative = np.median(error.mean(1) / (mean.mean(1) + 0.1 * mean.mean()))
    print(f"{len(mean)} points, {min(part[2] for part in parts)} paths each, median standard error {100 * relative:.2f} %")


if __name__ == "__main__":
    try:
        main()
    except glb.Unsupported as error:
        sys.exit(f"not compared: {error}")
