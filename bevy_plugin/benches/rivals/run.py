#!/usr/bin/env python3
"""Bakes the same texels by radiosity and by Blender's Cycles, compares both with a path tracer, and writes the table of the readme.

usage: python3 bevy_plugin/benches/rivals/run.py [--quick] [--scenes FILE.glb[@TEXELS_PER_METER] ...]

Needs cargo, and for the rivals Python 3.11 and 1.4 GB from PyPI (bpy, mitsuba, embreex), which go into
~/.cache/radiosity/rivals/venv once; RADIOSITY_RIVALS_VENV names an environment that has them already. A scene that fails is
reported and the others go on; a run that was stopped goes on where it was. All figures lie in
~/.cache/radiosity/rivals/run.json. Let nothing else run meanwhile.
"""

import argparse
import hashlib
import json
import os
import platform
import shutil
import subprocess
import sys
import time
from pathlib import Path

import verdict

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "radiosity" / "rivals"
PACKAGES = ["bpy==4.5.*", "mitsuba", "embreex", "numpy"]
SAMPLES = [16, 64, 256]
FEWER_SAMPLES = [4, 1]
MODES = ["imported", "tuned"]
QUALITIES = ["draft", "medium"]
BAKE = ["--profile", "bake", "-p", "bevy_radiosity", "--no-default-features", "--features", "cli"]
GALLERY = ["-p", "bevy_radiosity", "--features", "cli,viewer", "--example", "gallery"]


class Failed(Exception):
    """Something outside did not work; the text says what to do."""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="two scenes, Cycles with 16 samples only; the readme stays as it is")
    parser.add_argument("--scenes", nargs="+", metavar="FILE.glb[@N]", help="instead of the usual ones; N texels per meter")
    parser.add_argument("--budget-minutes", type=float, default=25, help="leave out Cycles' longest runs beyond that (%(default)s)")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="for both bakers (%(default)s)")
    parser.add_argument("--fresh", action="store_true", help="start anew even if the last run was not finished")
    parser.add_argument("--bake", type=Path, metavar="FILE", help="an existing bake program, instead of building it")
    parser.add_argument("--gallery", type=Path, metavar="DIR", help="the gallery's scenes, instead of building it")
    parser.add_argument("--table-only", action="store_true", help="write the tables from the last run's figures")
    return parser.parse_args()


def call(command, seconds=3600, show=False, **options):
    """Runs a program and gives what it printed; its last lines become the error."""
    command = [str(part) for part in command]
    try:
        options = options if show else {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True} | options
        done = subprocess.run(command, timeout=seconds, **options)
    except FileNotFoundError:
        raise Failed(f"{command[0]} is not installed") from None
    except subprocess.TimeoutExpired:
        raise Failed(f"{command[0]} took more than {seconds:.0f} seconds") from None
    if done.returncode != 0:
        last = " / ".join((done.stdout or "").strip().splitlines()[-3:])
        raise Failed(f"{Path(command[0]).name} {Path(command[1]).name} ended with {done.returncode}: {last}")
    return done.stdout or ""


# The environment of the rivals.


def environment():
    """A Python with the rivals; made where there is none."""
    given = os.environ.get("RADIOSITY_RIVALS_VENV")
    folder = Path(given) if given else CACHE / "venv"
    python = folder / "bin" / "python"
    if given and not python.exists():
        raise Failed(f"RADIOSITY_RIVALS_VENV: there is no {python}")
    complete = folder / "complete"
    if not given and not complete.exists():
        make_environment(folder, python)
        complete.touch()
    return python


def make_environment(folder, python):
    base = next((name for name in ("python3.11", sys.executable) if is_3_11(name)), None)
    if base is None:
        raise Failed("bpy 4.5 needs Python 3.11 as python3.11 (apt-get install python3.11-venv, or pyenv, or uv python install 3.11)")
    print(f"== {folder}: {', '.join(PACKAGES)}, 1.4 GB, once")
    try:
        call([base, "-m", "venv", folder])
    except Failed as error:
        raise Failed(f"no virtual environment could be made (apt-get install python3-venv): {error}") from None
    try:
        call([python, "-m", "pip", "install", "--quiet", *PACKAGES], show=True)
    except Failed as error:
        raise Failed(f"the rivals could not be installed; is there a network? {error}") from None


def is_3_11(name):
    try:
        return call([name, "-c", "import sys; print(sys.version_info[:2] == (3, 11))"]).strip() == "True"
    except Failed:
        return False


def continue_in(python):
    """Goes on in the environment of the rivals, for which numpy is there."""
    if os.environ.get("RADIOSITY_RIVALS_INSIDE") != str(python):
        os.environ["RADIOSITY_RIVALS_INSIDE"] = str(python)
        os.execv(python, [str(python), *sys.argv])


# What is compared.


def build(bake):
    """The program, and the scenes that the repository makes."""
    if bake is None:
        print("== building bake")
        lines = call(["cargo", "build", *BAKE, "--bin", "bake", "--message-format", "json"], cwd=ROOT, stderr=None).splitlines()
        artifacts = [json.loads(line) for line in lines if line.startswith("{")]
        bake = next(found["executable"] for found in artifacts if found.get("target", {}).get("name") == "bake")
    CACHE.mkdir(parents=True, exist_ok=True)
    return Path(shutil.copy2(bake, CACHE / "bake"))


def make_scenes(asked, bake):
    """Scenes that the repository makes, and those beside it."""
    import scenes

    made, beside = CACHE / "scenes", ROOT.parent / "shared" / "scenes"
    made.mkdir(parents=True, exist_ok=True)
    call([bake, "--quality", "draft", "--out", made / "built_in"])
    shutil.copy(made / "built_in" / "scene.glb", made / "cornell.glb")
    gallery = made if asked.quick else asked.gallery or make_gallery()
    if not beside.exists():
        print(f"== {beside} is not there: without its scenes")
    return scenes.usual(made, gallery, beside)


def make_gallery():
    """The folder of the gallery's scenes; they may be missing."""
    folder = CACHE / "gallery"
    print("== building the gallery for its scenes")
    try:
        call(["cargo", "run", "--quiet", *GALLERY, "--", "--scenes", folder], cwd=ROOT)
    except Failed as error:
        print(f"== without the gallery's scenes: {error}")
    return folder


def fingerprint(asked, bake, paths):
    """Of all that a run's figures hang on; an unfinished run goes on only if it is the same."""
    parts = [bake.read_bytes(), *(script.read_bytes() for script in sorted(HERE.glob("*.py")))]
    parts += [str((asked.quick, asked.threads, [str(path) for path in paths])).encode()]
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


def machine(threads):
    cpu = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [line.split(":")[1].strip() for line in info.read_text().splitlines() if line.startswith("model name")]
        cpu = names[0] if names else cpu
    return {"cpu": cpu, "threads": threads, "load_before": os.getloadavg()[0]}


class Comparison:
    """One scene: its reference, and the runs of both bakers in turn."""

    def __init__(self, scene, state, asked, bake, save):
        import glb

        self.scene, self.asked, self.bake, self.save = scene, asked, bake, save
        self.folder = CACHE / "work" / scene.name
        self.folder.mkdir(parents=True, exist_ok=True)
        self.found = state["scenes"].setdefault(scene.name, {"ours": {}, "cycles": {mode: {} for mode in MODES}})
        self.found["density"] = scene.density
        self.found.pop("failed", None)
        self.source = self.folder / f"{scene.name}.glb"
        glb.write_without_ranges(scene.path, self.source)
        self.has_error = "--error " in call([bake, "--help"])

    def run(self, seconds):
        """All of it; Cycles' runs that would take more than what is left of `seconds` are left out."""
        end = time.monotonic() + seconds
        self.reference = self.find_reference()
        settings = self.settings()
        self.ours(settings)
        for samples in SAMPLES[:1] if self.asked.quick else SAMPLES:
            for mode in MODES:
                self.cycles_more(mode, samples, end)
            self.ours(settings)
        for mode in MODES:
            self.cycles_fewer(mode)
        last = self.last_settings()
        for _ in range(1 if self.asked.quick else 3):
            self.ours(last)
        self.embree()

    def cycles_more(self, mode, samples, end):
        """More samples, unless those before were enough or time is short."""
        known = list(self.found["cycles"][mode].values())
        if any(run["rms"] <= verdict.GOAL_ERROR for run in known) or any(run["samples"] < samples / 4 for run in known[-1:]):
            return
        takes = max((run["seconds"] * samples / run["samples"] for run in known), default=0)
        if known and takes > end - time.monotonic():
            print(f"  Cycles, {mode}, {samples} samples: left out, would take up to {takes:.0f} s")
        else:
            self.cycles(mode, samples)

    def cycles_fewer(self, mode):
        """Where the goal's error is reached with the fewest samples, the time for it lies between it and less."""
        for samples in FEWER_SAMPLES:
            if max(run["rms"] for run in self.found["cycles"][mode].values()) > verdict.GOAL_ERROR:
                return
            self.cycles(mode, samples)

    def settings(self):
        settings = {quality: ["--quality", quality] for quality in QUALITIES}
        return settings | ({"error 2 %": ["--error", "2%"]} if self.has_error else {})

    def last_settings(self):
        """What comes near to the error at which both are compared, now that it is known."""
        errors = [verdict.common_error(list(self.found["cycles"][mode].values())) for mode in MODES]
        if self.has_error:
            aims = {f"{100 * share * error:.2g}" for error in errors for share in (1, 0.7)}
            return {f"error {aim} %": ["--error", f"{aim}%"] for aim in sorted(aims)}
        ours = list(self.found["ours"].values())
        return {"high": ["--quality", "high"]} if any(verdict.fastest(ours, error) is None for error in errors) else {}

    def find_reference(self):
        if self.scene.points is not None:
            self.found["reference"] = "given"
            return self.scene.points
        points, seconds = (150, 20) if self.asked.quick else (350, 60)
        path = CACHE / "references" / f"{self.scene.name}-{self.scene.digest()}-{points}-{seconds}.csv"
        self.found["reference"] = f"Mitsuba 3, {seconds} s"
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            made = path.with_suffix(".part")
            print("  reference:", call([sys.executable, HERE / "truth.py", self.source, made, "--points", points, "--seconds", seconds]).strip().splitlines()[-1])
            made.rename(path)
        return path

    def ours(self, settings):
        """Each setting once more; its time is the median of all runs."""
        for name, options in settings.items():
            out = self.folder / name.replace(" ", "").replace("%", "")
            density = f"{self.scene.density:g}"
            call([self.bake, self.source, "--texels-per-meter", density, "--threads", self.asked.threads, "--out", out, *options])
            report = json.loads((out / "report.json").read_text())
            run = self.found["ours"].setdefault(name, {"all_seconds": []})
            run["all_seconds"].append(sum(stage["seconds"] for stage in report["stages"]))
            run["seconds"] = sorted(run["all_seconds"])[len(run["all_seconds"]) // 2]
            run["rays"] = sum(stage["rays"] for stage in report["stages"])
            run["peak_memory_bytes"], run["estimated_rms"] = report["peak_memory_bytes"], report["estimated_error"]["rms"]
            if "rms" not in run:
                run |= self.error(out)
            self.found["triangles"], self.found["texels"] = report["triangles"], report["valid_texels"]
            self.layout = out
            self.tell(f"radiosity, {name}", run)

    def cycles(self, mode, samples):
        runs = self.found["cycles"][mode]
        if str(samples) in runs:
            return
        out = self.folder / f"cycles_{mode}{samples}"
        script = HERE / "blender_cycles.py"
        printed = call([sys.executable, script, self.layout, out, samples, self.asked.threads, mode])
        run = json.loads(next(line for line in reversed(printed.splitlines()) if line.startswith("{")))
        runs[str(samples)] = run | self.error(out)
        self.tell(f"Cycles, {mode}, {samples} samples", runs[str(samples)])

    def error(self, folder):
        return json.loads(call([sys.executable, HERE / "error.py", folder, self.reference]).strip().splitlines()[-1])

    def embree(self):
        """Embree on the very rays of a bake of medium quality, each on one thread and in turn; the best of each."""
        out, rays = self.folder / "one_thread", self.folder / "rays"
        options = ["--threads", 1, "--texels-per-meter", f"{self.scene.density:g}", "--out", out]
        best = self.found.setdefault("embree", {"ours": float("inf"), "embree": float("inf")})
        for turn in range(1 if self.asked.quick else 2):
            # Writing the rays takes time that a bake does not have.
            call([self.bake, self.source, *options])
            report = json.loads((out / "report.json").read_text())
            best["ours"] = min(best["ours"], sum(stage["seconds"] for stage in report["stages"]))
            if turn == 0:
                call([self.bake, self.source, *options, "--dump-rays", rays])
            traced = json.loads(call([sys.executable, HERE / "embree_rays.py", out, rays]))
            best["embree"], best["rays"] = min(best["embree"], traced["scaled"]["seconds"]), traced["scaled"]["rays"]
        rays.unlink()
        best["ratio"] = best["ours"] / best["embree"]
        print(f"  Embree: {best['embree']:.2f} s for {best['rays'] * 1e-6:.1f} million rays, ours {best['ours']:.2f} s: {best['ratio']:.2f}")
        self.save()

    def tell(self, name, run):
        print(f"  {name}: {run['seconds']:.2f} s, rms {100 * run['rms']:.2f} %, median {100 * run['p50']:.2f} %", flush=True)
        self.save()


def compare(asked, bake):
    """All scenes; what is known is kept after every run."""
    import scenes

    paths = asked.scenes or make_scenes(asked, bake)
    if asked.quick and not asked.scenes:
        paths = [path for path in paths if path.stem in ("furnace", "cornell")]
    path, mark = CACHE / "run.json", fingerprint(asked, bake, paths)
    state = json.loads(path.read_text()) if path.exists() else {}
    if asked.fresh or state.get("finished") or state.get("fingerprint") != mark:
        state = {"fingerprint": mark, "machine": machine(asked.threads), "scenes": {}, "finished": False}
        if state["machine"]["load_before"] > 0.5:
            print(f"== the machine is busy, load {state['machine']['load_before']:.1f}: times will mean little")
    else:
        print("== going on with the run that was stopped")

    def save():
        path.write_text(json.dumps(state, indent=1))

    end = time.monotonic() + 60 * asked.budget_minutes
    for index, scene_path in enumerate(paths):
        name = Path(str(scene_path).partition("@")[0]).stem
        if state["scenes"].get(name, {}).get("finished"):
            continue
        print(f"== {name}", flush=True)
        left = max(end - time.monotonic(), 60)
        try:
            scene = scenes.scene(scene_path)
            # A scene may take what the others leave, but not their share.
            Comparison(scene, state, asked, bake, save).run(left / (len(paths) - index) * 2)
            state["scenes"][name]["finished"] = True
        except Exception as error:  # noqa: BLE001  (whatever a scene does, the others go on)
            state["scenes"].setdefault(name, {})["failed"] = str(error)
            print(f"  FAILED: {error}")
        save()
    state["finished"] = True
    save()
    return state


def write_tables(state, readme_too):
    import table

    (HERE / "results.md" if readme_too else CACHE / "results.md").write_text(table.every_run(state))
    summary = table.summary(state)
    print(summary)
    if readme_too:
        readme = ROOT / "README.md"
        readme.write_text(table.rewrite(readme.read_text(), summary))


def main():
    asked = arguments()
    continue_in(environment())
    if asked.table_only:
        state = json.loads((CACHE / "run.json").read_text())
    else:
        state = compare(asked, build(asked.bake))
    write_tables(state, readme_too=not asked.quick and not asked.scenes)


if __name__ == "__main__":
    try:
        main()
    except Failed as error:
        sys.exit(f"{error}")
