"""Path-traces a .glb from its camera and writes what a camera of this exposure shows, as a reference beside a bake.

    pip install mitsuba pillow
    python reference_picture.py SCENE.glb PICTURE.png --ev100 EV [--width 640] [--samples 256]
        [--radiance KEPT.npy] [--beside OURS.png OUT.png]

Surfaces are diffuse with their base color; one-sided ones block light from behind and are not seen from there. Lights
are those of KHR_lights_punctual, the sun with its disk of 0.53 degrees, and emissive materials. Tone mapping is Khronos
PBR Neutral, as in the pictures of `bake`. `--beside` puts another picture of the same view to the left of this one.
Where a library of LLVM is not found, name it in DRJIT_LIBLLVM_PATH.
"""

import argparse
import json
import math
import os
import struct
import tempfile

import mitsuba as mi
import numpy as np
from PIL import Image

mi.set_variant("llvm_ad_rgb")
import drjit as dr  # noqa: E402  (after the variant is set)

TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
SUN_RADIUS = math.radians(0.53 / 2)
# Directions that stand for the disk of the sun.
SUN_POINTS = 6


class Glb:
    """The JSON and the binary chunk of a file."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        length = struct.unpack("<I", data[12:16])[0]
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[28 + length :]

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = np.dtype(TYPES[accessor["componentType"]]), WIDTHS[accessor["type"]]
        offset = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", kind.itemsize * width)
        return np.ndarray((accessor["count"], width), kind, self.binary, offset, (stride, kind.itemsize)).copy()

    def nodes(self):
        """Every node with its transform to the world."""
        scene = self.json["scenes"][self.json.get("scene", 0)]
        waiting = [(index, np.eye(4)) for index in scene["nodes"]]
        while waiting:
            index, above = waiting.pop()
            node = self.json["nodes"][index]
            world = above @ local(node)
            waiting += [(child, world) for child in node.get("children", [])]
            yield node, world


def local(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, :3] *= np.array(node.get("scale", [1, 1, 1]))
    matrix[:3, 3] = node.get("translation", [0, 0, 0])
    return matrix


def rgb(color):
    return {"type": "rgb", "value": [float(channel) for channel in color]}


def surface(glb, primitive, world, folder, name):
    """A primitive as Mitsuba has it, and whether it is seen from both sides."""
    attributes = {key: glb.accessor(index) for key, index in primitive["attributes"].items()}
    positions = attributes["POSITION"] @ world[:3, :3].T + world[:3, 3]
    faces = glb.accessor(primitive["indices"]).reshape(-1, 3)
    if np.linalg.det(world[:3, :3]) < 0:
        faces = faces[:, ::-1]
    smooth = "NORMAL" in attributes
    mesh = mi.Mesh(name, len(positions), len(faces), has_vertex_normals=smooth)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = positions.astype(np.float32).ravel()
    parameters["faces"] = faces.astype(np.uint32).ravel()
    if smooth:
        normals = attributes["NORMAL"] @ np.linalg.inv(world[:3, :3])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        parameters["vertex_normals"] = normals.astype(np.float32).ravel()
    parameters.update()
    path = os.path.join(folder, f"{name}.ply")
    mesh.write_ply(path)
    material = glb.json["materials"][primitive["material"]] if "material" in primitive else {}
    base = material.get("pbrMetallicRoughness", {})
    reflectance = np.array(base.get("baseColorFactor", [1, 1, 1, 1])[:3]) * (1 - base.get("metallicFactor", 1))
    strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
    emission = np.array(material.get("emissiveFactor", [0, 0, 0])) * strength
    diffuse = {"type": "diffuse", "reflectance": rgb(reflectance)}
    both = material.get("doubleSided", False)
    shape = {"type": "ply", "filename": path, "face_normals": not smooth}
    shape["bsdf"] = {"type": "twosided", "inner": diffuse} if both else diffuse
    if emission.max() > 0:
        shape["emitter"] = {"type": "area", "radiance": rgb(emission)}
    return shape, both


def light(description, world):
    """A light as Mitsuba has it, or several that stand for the disk of the sun."""
    color = np.array(description.get("color", [1, 1, 1])) * description.get("intensity", 1)
    place, forward = world[:3, 3], -world[:3, 2] / np.linalg.norm(world[:3, 2])
    if description["type"] == "point":
        return [{"type": "point", "position": place.tolist(), "intensity": rgb(color)}]
    if description["type"] == "spot":
        cone = description["spot"]
        target = mi.ScalarTransform4f().look_at(place.tolist(), (place + forward).tolist(), world[:3, 1].tolist())
        outer, inner = cone.get("outerConeAngle", math.pi / 4), cone.get("innerConeAngle", 0)
        return [{"type": "spot", "intensity": rgb(color), "to_world": target,
                 "cutoff_angle": math.degrees(outer), "beam_width": math.degrees(inner)}]
    side = np.cross(forward, [1, 0, 0] if abs(forward[0]) < 0.9 else [0, 1, 0])
    side /= np.linalg.norm(side)
    up = np.cross(side, forward)
    suns = []
    for index in range(SUN_POINTS):
        # Vogel's spiral covers a disk evenly.
        radius, turn = SUN_RADIUS * math.sqrt((index + 0.5) / SUN_POINTS), index * math.pi * (3 - math.sqrt(5))
        direction = forward + radius * (math.cos(turn) * side + math.sin(turn) * up)
        suns.append({"type": "directional", "direction": direction.tolist(), "irradiance": rgb(color / SUN_POINTS)})
    return suns


def load(path):
    """The scene, for each of its shapes whether it is seen from both sides, and its camera."""
    glb, shapes, sides, lights, camera = Glb(path), {}, [], [], None
    with tempfile.TemporaryDirectory() as folder:
        for node, world in glb.nodes():
            if "mesh" in node:
                for primitive in glb.json["meshes"][node["mesh"]]["primitives"]:
                    name = f"shape{len(shapes):05}"
                    shapes[name], both = surface(glb, primitive, world, folder, name)
                    sides.append(both)
            lamp = node.get("extensions", {}).get("KHR_lights_punctual")
            if lamp:
                lights += light(glb.json["extensions"]["KHR_lights_punctual"]["lights"][lamp["light"]], world)
            if "camera" in node and camera is None:
                camera = glb.json["cameras"][node["camera"]]["perspective"], world
        lamps = {f"light{index:05}": lamp for index, lamp in enumerate(lights)}
        scene = mi.load_dict({"type": "scene", **shapes, **lamps})
    return scene, sides, camera


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
