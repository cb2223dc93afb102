#!/usr/bin/env python3
"""Error and time of the example `view_factors` beside those of pyviewfactor, on the same geometries.

    cargo build -p radiosity --release --example view_factors
    pip install pyviewfactor
    python3 examples/view_factors/compare_pyviewfactor.py [--accuracy E] [--repeat 3]

The geometries are those of pyviewfactor's own tests and the inputs beside this file. The time is that of the matrix
alone, best of some runs; pyviewfactor is warmed up first, so that its compiler does not count.
"""

import argparse
import math
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
BINARY = HERE.parents[1] / "target/release/examples/view_factors"

OPPOSITE, ADJACENT = 0.1998248956984, 0.2000437760754
L_ROOM_ROW_1 = [0, 0.1131544143036, 0.3780928977993, 0.0274734057075, 0.0328902475631, 0.1823559036686,
                0.1330165654789, 0.1330165654789]


def vs3(title, faces, control=""):
    """An input with vertices of its own for each face."""
    lines = [f"T {title}", f"C {control}", "F 3"]
    vertices = [vertex for face in faces for vertex in face]
    lines += [f"V {n} " + " ".join(repr(float(x)) for x in vertex) for n, vertex in enumerate(vertices, 1)]
    first = 1
    for n, face in enumerate(faces, 1):
        corners = [first + k for k in range(len(face))] + [0] * (4 - len(face))
        lines.append(f"S {n} " + " ".join(map(str, corners)) + f" 0 0 1 face-{n}")
        first += len(face)
    return "\n".join(lines + ["End", ""])


def square_grid(count):
    """The faces of a cube seen from inside, each cut into count x count cells."""
    faces = []
    for axis in range(3):
        for side in (0.0, 1.0):
            for i in range(count):
                for j in range(count):
                    ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    face = []
                    for u, v in ring if side == 0.0 else reversed(ring):
                        point = [0.0, 0.0, 0.0]
                        point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = side, u / count, v / count
                        face.append(point)
                    faces.append(face)
    return faces


def sphere():
    """A coarse sphere seen from inside: 5 meridians, 5 parallels with the poles, as in pyviewfactor's tests."""
    ring = [[[10 * math.sin(t) * math.cos(p), 10 * math.sin(t) * math.sin(p), 10 * math.cos(t)]
             for p in (2 * math.pi * k / 5 for k in range(5))] for t in (math.pi * k / 4 for k in (1, 2, 3))]
    top, bottom = [0, 0, 10], [0, 0, -10]
    faces = []
    for k in range(5):
        n = (k + 1) % 5
        faces += [[top, ring[0][n], ring[0][k]], [bottom, ring[2][k], ring[2][n]]]
        for a, b in ((ring[0], ring[1]), (ring[1], ring[2])):
            faces += [[a[k], a[n], b[n]], [a[k], b[n], b[k]]]
    return faces


def entries(expected):
    """The largest error of some entries, given as {(row, column): value} with rows from 0."""
    return lambda matrix: max(abs(matrix[i][j] - value) for (i, j), value in expected.items())


def closure(matrix):
    return max(abs(math.fsum(row) - 1) for row in matrix)


def cases():
    """Name, input text, what the error is."""
    below = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    above = [[x, y, 1] for x, y, _ in reversed(below)]
    wall = [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]]
    triangles = [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [0, 1, 0], [0, 0, 1]]]
    yield "parallel squares", vs3("parallel", [below, above]), entries({(0, 1): OPPOSITE})
    yield "squares with a common edge", vs3("edge", [below, wall]), entries({(0, 1): ADJACENT})
    # By symmetry: the hypotenuse face of the corner of a cube sees each of the three others with 1/3.
    yield "triangles with a common edge", vs3("triangles", triangles), entries({(0, 1): (3 - math.sqrt(3)) / 6})
    yield "sphere, 30 triangles: row sums", vs3("sphere", sphere()), closure
    yield "cube, 384 cells: row sums", vs3("cells", square_grid(8)), closure
    cube = {(i, j): OPPOSITE if i % 3 == j % 3 else ADJACENT for i in range(6) for j in range(6) if i != j}
    yield "cube.vs3", (HERE / "cube.vs3").read_text(), entries(cube)
    yield "square_obstruction.vs3", (HERE / "square_obstruction.vs3").read_text(), entries({(0, 1): 0.75 * OPPOSITE})
    for name in ("l_room.vs3", "l_room_in_planes.vs3"):
        row = {(0, j): value for j, value in enumerate(L_ROOM_ROW_1)}
        yield name, (HERE / name).read_text(), entries(row)


def run_ours(binary, text, accuracy, repeat):
    """Matrix, seconds, and the surfaces as (corners, row), from the report with everything in it."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "input.vs3"
        open_and_black = re.sub("(encl|emit)=1", "", text)
        file.write_text(open_and_black.replace("\nF", "\nC list=3\nF", 1))
        command = [str(binary), str(file), *(["--accuracy", accuracy] if accuracy else [])]
        reports = [subprocess.run(command, check=True, capture_output=True, text=True).stdout for _ in range(repeat)]
    seconds = min(float(re.search(r"accuracy .*, ([0-9.]+) ms", report)[1]) / 1e3 for report in reports)
    report = reports[0]
    matrix = [[float(x) for x in line.split()[1:]] for line in report.split("View factors:\n")[1].splitlines()]
    corners = [[[float(x) for x in point.split(",")] for point in re.findall(r"\(([^)]*)\)", line)]
               for line in report.splitlines() if " Radiating " in line]
    row_of = list(range(len(corners)))
    for row, numbers in re.findall(r"^ *(\d+) .*\(surfaces ([\d ]+)\)$", report, flags=re.M):
        for number in numbers.split():
            row_of[int(number) - 1] = int(row) - 1
    return matrix, seconds, list(zip(corners, row_of))


def run_pyviewfactor(surfaces, repeat):
    """The same matrix by pyviewfactor: `F(j -> i)` at `[i][j]`; what is between counts if it hides the centers."""
    import numpy as np
    import pyviewfactor
    import pyvista

    points, faces = [], []
    for corners, _ in surfaces:
        faces += [len(corners), *range(len(points), len(points) + len(corners))]
        points += corners
    mesh = pyvista.PolyData(np.array(points, float), np.array(faces))
    obstacles = mesh.triangulate()
    pair = [pyviewfactor.fc_unstruc2poly(mesh.extract_cells(cell)) for cell in range(2)]

    def compute():
        if len(surfaces) > 2:
            return pyviewfactor.compute_viewfactor_matrix(mesh, obstacles=obstacles)
        return [[0, 0], [pyviewfactor.compute_viewfactor(pair[1], pair[0]), 0]]

    seconds, found = [], None
    for _ in range(repeat + 1):
        start = time.perf_counter()
        found = compute()
        seconds.append(time.perf_counter() - start)
    areas = [pyviewfactor.polygon_area(np.array(corners)) for corners, _ in surfaces]
    count = 1 + max(row for _, row in surfaces)
    exchange, area = np.zeros((count, count)), np.zeros(count)
    for i, (_, row) in enumerate(surfaces):
        area[row] += areas[i]
        for j, (_, column) in enumerate(surfaces):
            exchange[row][column] += found[j][i] * areas[i]
    return (exchange / area[:, None]).tolist(), min(seconds[1:])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, default=BINARY)
    parser.add_argument("--accuracy", help="as for view_factors, which without it takes that of the input or 1e-6")
    parser.add_argument("--repeat", type=int, default=3)
    args = parser.parse_args()
    if not args.binary.exists():
        sys.exit(f"{args.binary} is missing; build it: cargo build -p radiosity --release --example view_factors")
    try:
        import pyviewfactor  # noqa: F401
        has_rival = True
    except ImportError:
        has_rival = False
        print("pyviewfactor is missing, so its columns stay empty; install it: pip install pyviewfactor\n")
    print("| geometry | error, ours | error, pyviewfactor | time, ours | time, pyviewfactor |\n|---|---|---|---|---|")
    for name, text, error in cases():
        matrix, seconds, surfaces = run_ours(args.binary, text, args.accuracy, args.repeat)
        if has_rival:
            rival, rival_seconds = run_pyviewfactor(surfaces, args.repeat)
            theirs = f"{error(rival):.1e} | {1e3 * seconds:.2f} ms | {1e3 * rival_seconds:.2f} ms |"
        else:
            theirs = f"| {1e3 * seconds:.2f} ms | |"
        print(f"| {name} | {error(matrix):.1e} | {theirs}", flush=True)


if __name__ == "__main__":
    main()
