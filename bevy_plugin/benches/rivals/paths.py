#!/usr/bin/env python3
"""Follows paths of light through the same scenes by radiosity and by Mitsuba 3: the same means, and the time for the same noise.

    pip install mitsuba numpy
    python3 bevy_plugin/benches/rivals/paths.py [--side 64] [--paths 1024] [--program FILE] [SCENE.glb ...]

The scenes: a closed box with a lamp, with a mirror on a wall, with a pane of glass before it, and those that are named;
else `cornell.glb` of `../shared/scenes` if it is there. All are of triangles; surfaces are diffuse, perfect mirrors or smooth glass. Mitsuba runs
in its variants for one ray at a time (scalar) and for many (LLVM), whose kernels are compiled before the clock starts. Each
pixel has a standard error, that of ours from means of 16 paths, that of Mitsuba from means of passes. Seconds are those of
all processors together, so that they can be told where other programs run too.
"""

import argparse
import math
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import glb

try:
    from truth import dr, mi
except ImportError:
    sys.exit("Mitsuba is not installed, so that there is nothing to compare with: pip install mitsuba")

ROOT = Path(__file__).resolve().parents[3]
CORNELL = ROOT.parent / "shared" / "scenes" / "cornell.glb"
VARIANTS = ["scalar_rgb", "llvm_ad_rgb"]
# Of Mitsuba, whose means have a standard error.
PASSES = 16
LAMP = 8.0


def quad(a, b, c, d):
    """Two triangles, counter-clockwise seen from their front."""
    return [[a, b, c], [a, c, d]]


def box(low, high, inside=False):
    """Twelve triangles that look outwards, or inwards."""
    (x, y, z), (X, Y, Z) = low, high
    a, b, c, d, e, f, g, h = (x, y, z), (X, y, z), (X, y, Z), (x, y, Z), (x, Y, z), (X, Y, z), (X, Y, Z), (x, Y, Z)
    sides = [quad(*side) for side in ((a, b, c, d), (h, g, f, e), (b, a, e, f), (d, c, g, h), (a, d, h, e), (c, b, f, g))]
    triangles = [triangle for side in sides for triangle in side]
    return [triangle[::-1] for triangle in triangles] if inside else triangles


def scenes(files):
    """For each its name, its camera (eye, target, angle) and its parts: kind, numbers, triangles."""
    camera = ((0.5, 0.5, 0.97), (0.5, 0.45, 0.0), 75)
    lamp = ("lambert", [0, 0, 0, LAMP], quad((0.3, 0.99, 0.3), (0.7, 0.99, 0.3), (0.7, 0.99, 0.7), (0.3, 0.99, 0.7)))
    room = [
        ("lambert", [0.7, 0.6, 0.5], box((0, 0, 0), (1, 1, 1), inside=True)),
        ("lambert", [0.2, 0.5, 0.7], box((0.15, 0, 0.2), (0.4, 0.5, 0.45))),
        lamp,
    ]
    mirror = ("mirror", [0.9, 0.8, 0.7], quad((0.1, 0.1, 0.01), (0.9, 0.1, 0.01), (0.9, 0.9, 0.01), (0.1, 0.9, 0.01)))
    glass = ("glass", [1.5], box((0.05, 0.02, 0.55), (0.75, 0.75, 0.57)))
    yield "box", camera, room
    yield "mirror", camera, [*room, mirror]
    yield "glass", camera, [*room, glass]
    for file in files:
        parts = [("lambert", [*s.reflectance, s.emission.max()], s.corners().tolist()) for s in glb.read(file)[0]]
        corners = np.concatenate([np.reshape(triangles, (-1, 3)) for _, _, triangles in parts])
        low, high = corners.min(0), corners.max(0)
        middle = (low + high) / 2
        yield file.stem, (middle + [0, 0, 0.48 * (high - low)[2]], middle, 75), parts


def text(camera, parts):
    """The scene as the benchmark `path_tracing` of the core reads it."""
    numbers = lambda values: " ".join(f"{value:.9g}" for value in np.ravel(values))
    lines = [f"{word} {numbers(value)}" for word, value in zip(("eye", "target", "fov"), camera)]
    for kind, values, triangles in parts:
        lines += [f"{kind} {numbers(values)}", *(f"triangle {numbers(triangle)}" for triangle in triangles)]
    return "\n".join(lines) + "\n"


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def ours(program, folder, camera, parts, side, paths):
    """Mean and standard error of each pixel, and seconds."""
    scene, out = folder / "scene.txt", folder / "out.csv"
    scene.write_text(text(camera, parts))
    start = cpu_of_children()
    subprocess.run([*program, scene, out, str(side), str(paths)], check=True, stdout=subprocess.DEVNULL)
    seconds = cpu_of_children() - start
    values = np.loadtxt(out, delimiter=",").reshape(side * side, 2, 3)
    return values[:, 0], values[:, 1], seconds


def shape(folder, index, kind, numbers, triangles):
    """A part as Mitsuba takes it."""
    corners = np.reshape(triangles, (-1, 3))
    mesh = mi.Mesh(f"part{index}", len(corners), len(triangles))
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = corners.astype(np.float32).ravel()
    parameters["faces"] = np.arange(len(corners), dtype=np.uint32)
    parameters.update()
    path = str(folder / f"{index}.ply")
    mesh.write_ply(path)
    color = lambda values: {"type": "rgb", "value": [float(value) for value in values]}
    description = {"type": "ply", "filename": path, "face_normals": True}
    match kind:
        case "lambert":
            description["bsdf"] = {"type": "diffuse", "reflectance": color(numbers[:3])}
        case "mirror":
            description["bsdf"] = {"type": "conductor", "material": "none", "specular_reflectance": color(numbers[:3])}
        case "glass":
            description["bsdf"] = {"type": "dielectric", "int_ior": numbers[0], "ext_ior": 1.0}
    if len(numbers) > 3 and numbers[3] > 0:
        description["emitter"] = {"type": "area", "radiance": color([numbers[3]] * 3)}
    return description


def theirs(variant, folder, camera, parts, side, paths):
    """The same by Mitsuba."""
    mi.set_variant(variant)
    eye, target, angle = camera
    place = mi.ScalarTransform4f().look_at(origin=list(map(float, eye)), target=list(map(float, target)), up=[0, 1, 0])
    film = {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    sensor = {"type": "perspective", "fov": angle, "fov_axis": "y", "to_world": place, "near_clip": 1e-3, "film": film}
    integrator = {"type": "path", "max_depth": -1, "rr_depth": 5}
    shapes = {f"part{index}": shape(folder, index, *part) for index, part in enumerate(parts)}
    scene = mi.load_dict({"type": "scene", "integrator": integrator, "sensor": sensor, **shapes})
    samples = max(1, paths // PASSES)
    render = lambda seed: np.array(mi.render(scene, spp=samples, seed=seed), np.float64).reshape(-1, 3)
    render(1000)
    start = time.process_time()
    passes = np.array([render(seed) for seed in range(PASSES)])
    seconds = time.process_time() - start
    return passes.mean(0), passes.std(0, ddof=1) / math.sqrt(PASSES), seconds


def noise(mean, error):
    """Root mean square of the standard errors over the mean."""
    return math.sqrt((error**2).mean()) / mean.mean()


def program(given):
    """The benchmark of the core; built where none is given."""
    if given:
        return [given]
    return ["cargo", "bench", "-q", "--manifest-path", ROOT / "Cargo.toml", "-p", "radiosity", "--bench", "path_tracing", "--"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=int, default=64, help="pixels in a row and rows (%(default)s)")
    parser.add_argument("--paths", type=int, default=1024, help="for each pixel (%(default)s)")
    parser.add_argument("--program", type=Path, help="the benchmark path_tracing, instead of building it")
    parser.add_argument("scenes", nargs="*", type=Path, metavar="SCENE.glb", help="closed boxes of diffuse surfaces that shine")
    args = parser.parse_args()
    files = args.scenes or [file for file in [CORNELL] if file.exists()]
    if not files:
        print(f"there is no {CORNELL}, which is left out", file=sys.stderr)
    run = program(args.program)
    count = args.side**2 * args.paths
    print("| scene | program | mean | apart, standard errors | pixels within 3 | paths / CPU s | noise | time for our noise |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if not args.program:
            subprocess.run(run, check=True, stdout=subprocess.DEVNULL)
        for scene, camera, parts in scenes(files):
            mean, error, seconds = ours(run, folder, camera, parts, args.side, args.paths)
            gray, level = mean.mean(), noise(mean, error)
            print(f"| {scene} | radiosity | {gray:.4f} | | | {count / seconds:,.0f} | {100 * level:.2f} % | {seconds:.1f} s |")
            for variant in VARIANTS:
                other, other_error, other_seconds = theirs(variant, folder, camera, parts, args.side, args.paths)
                joint = np.sqrt(error**2 + other_error**2)
                # Of the mean of all pixels, whose channels go up and down together.
                whole = math.sqrt((joint.mean(1) ** 2).sum()) / len(mean)
                within = (np.abs(mean - other).mean(1) <= 3 * joint.mean(1) + 1e-6).mean()
                other_level = noise(other, other_error)
                print(
                    f"| | Mitsuba, {variant} | {other.mean():.4f} | {(gray - other.mean()) / whole:+.1f} | {100 * within:.1f} % "
                    f"| {count / other_seconds:,.0f} | {100 * other_level:.2f} % | {other_seconds * (other_level / level) ** 2:.1f} s |"
                )


if __name__ == "__main__":
    main()
