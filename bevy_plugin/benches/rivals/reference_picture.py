"""Path-traces a .glb from its camera and writes what a camera of this exposure shows, as a reference beside a bake.

    pip install mitsuba pillow
    python reference_picture.py SCENE.glb PICTURE.png --ev100 EV [--width 640] [--samples 256]
        [--radiance KEPT.npy] [--beside OURS.png OUT.png]

Surfaces are diffuse with their base color; one-sided ones block light from behind and are not seen from there. Lights
are those of KHR_lights_punctual, the sun with its disc of 0.53 degrees, and emissive materials. Tone mapping is Khronos
PBR Neutral, as in the pictures of `bake`. `--beside` puts another picture of the same view to the left of this one.
"""

import argparse
import math
import os
import tempfile
from dataclasses import replace

import numpy as np
from PIL import Image

import glb
from truth import SUN_RADIUS, dr, emitters, mi, shape

# Directions that stand for the disc of the sun.
SUN_POINTS = 6


def disc(lamp):
    """A lamp, or several that stand for the disc of the sun."""
    if lamp.kind != "directional":
        return [lamp]
    side = glb.normalized(np.cross(lamp.direction, np.eye(3)[np.argmin(np.abs(lamp.direction))]))
    up = np.cross(side, lamp.direction)
    # Vogel's spiral covers a disc evenly.
    points = [(SUN_RADIUS * math.sqrt((k + 0.5) / SUN_POINTS), k * math.pi * (3 - math.sqrt(5))) for k in range(SUN_POINTS)]
    offsets = [radius * (math.cos(turn) * side + math.sin(turn) * up) for radius, turn in points]
    strength = lamp.strength / SUN_POINTS
    return [replace(lamp, direction=lamp.direction + offset, strength=strength) for offset in offsets]


def load(path):
    """The scene, for each of its shapes whether it is seen from both sides, and its camera."""
    surfaces, lamps = glb.read(path)
    lights = [emitter for lamp in lamps for part in disc(lamp) for emitter in emitters(part)]
    with tempfile.TemporaryDirectory() as folder:
        shapes = {f"m{index:05}": shape(surface, folder, index, True) for index, surface in enumerate(surfaces)}
        scene = mi.load_dict({"type": "scene", **shapes, **{f"l{index:05}": light for index, light in enumerate(lights)}})
    return scene, [surface.double_sided for surface in surfaces], camera_of(path)


def camera_of(path):
    """The lens and the place of the first camera."""
    document, _ = glb.chunks(path)
    waiting = [(root, np.eye(4)) for root in document["scenes"][document.get("scene", 0)]["nodes"]]
    while waiting:
        index, parent = waiting.pop()
        node = document["nodes"][index]
        place = parent @ glb.local_place(node)
        if "camera" in node:
            return document["cameras"][node["camera"]]["perspective"], place
        waiting += [(child, place) for child in node.get("children", [])]
    raise glb.Unsupported("a scene without a camera")


def primary_rays(camera, width, height, sampler):
    """One ray through a random point of each pixel; pixels follow each other row by row, each `samples` times."""
    lens, world = camera
    count = dr.width(sampler.next_1d())
    samples = count // (width * height)
    pixel = dr.arange(mi.UInt32, count) // samples
    jitter = sampler.next_2d()
    x = (mi.Float(pixel % width) + jitter.x) / width
    y = (mi.Float(pixel // width) + jitter.y) / height
    slope = math.tan(lens["yfov"] / 2)
    local = mi.Vector3f((2 * x - 1) * slope * width / height, (1 - 2 * y) * slope, -1)
    columns = [mi.Vector3f(*[float(c) for c in world[:3, axis]]) for axis in range(3)]
    direction = dr.normalize(columns[0] * local.x + columns[1] * local.y + columns[2] * local.z)
    return mi.RayDifferential3f(mi.Point3f(*[float(c) for c in world[:3, 3]]), direction)


def pass_backs(scene, ray, both_sides):
    """Moves the origin of each ray behind the backs of one-sided surfaces, of which it sees nothing."""
    if all(both_sides):
        return ray
    for _ in range(8):
        hit = scene.ray_intersect_preliminary(ray, coherent=True)
        at = hit.compute_surface_interaction(ray, ray_flags=mi.RayFlags.Minimal)
        behind = hit.is_valid() & (dr.dot(at.n, ray.d) > 0)
        ray.o = dr.select(behind, at.p + ray.d * (1e-4 * (1 + dr.max(dr.abs(at.p)))), ray.o)
    return ray


def radiance(scene, both_sides, camera, width, samples):
    height = round(width / camera[0].get("aspectRatio", 4 / 3))
    integrator = mi.load_dict({"type": "path", "max_depth": -1, "rr_depth": 12})
    at_once = max(1, min(samples, 2_000_000 // (width * height)))
    total, done = np.zeros((height * width, 3)), 0
    while done < samples:
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(done + 1, width * height * at_once)
        ray = pass_backs(scene, primary_rays(camera, width, height, sampler), both_sides)
        color, _, _ = integrator.sample(scene, sampler, ray)
        total += np.array(color).reshape(3, -1, at_once).sum(2).T
        done += at_once
    return (total / done).reshape(height, width, 3)


def tone_mapped(color):
    """Khronos PBR Neutral (Khronos Group 2024), then sRGB."""
    start, fresnel, desaturation = 0.8 - 0.04, 0.04, 0.15
    least = color.min(2, keepdims=True)
    color = color - np.where(least < 0.08, least - 6.25 * least * least, fresnel)
    peak = color.max(2, keepdims=True)
    new_peak = np.where(peak < start, peak, 1 - (1 - start) ** 2 / (np.maximum(peak, start) + 1 - 2 * start))
    white = 1 - 1 / (desaturation * (peak - new_peak) + 1)
    color = color * np.where(peak < start, 1, new_peak / np.maximum(peak, 1e-9))
    color = np.clip(np.where(peak < start, color, color + (new_peak - color) * white), 0, 1)
    srgb = np.where(color <= 0.0031308, 12.92 * color, 1.055 * color ** (1 / 2.4) - 0.055)
    return (255 * srgb + 0.5).astype(np.uint8)


def main():
    parser = argparse.ArgumentParser(description="A reference picture of a .glb.")
    parser.add_argument("scene")
    parser.add_argument("picture")
    parser.add_argument("--ev100", type=float, required=True)
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--radiance", help="keeps cd/m2 in RGB as .npy; what is there already is not traced again")
    parser.add_argument("--beside", nargs=2, metavar=("OURS", "OUT"))
    args = parser.parse_args()
    if args.radiance and os.path.exists(args.radiance):
        color = np.load(args.radiance)
    else:
        color = radiance(*load(args.scene), args.width, args.samples)
        if args.radiance:
            np.save(args.radiance, color.astype(np.float32))
    picture = Image.fromarray(tone_mapped(color * 2**-args.ev100 / 1.2))
    picture.save(args.picture, optimize=True)
    if args.beside:
        ours = Image.open(args.beside[0]).convert("RGB").resize(picture.size, Image.Resampling.LANCZOS)
        both = Image.new("RGB", (2 * picture.width + 4, picture.height), "white")
        both.paste(ours, (0, 0))
        both.paste(picture, (picture.width + 4, 0))
        both.save(args.beside[1], optimize=True)


main()
