"""What was measured as Markdown: the summary in the readme, and every run in a file beside the scripts."""

import verdict

BEGIN, END = "<!-- rivals:begin -->", "<!-- rivals:end -->"
HEAD = ["scene", "triangles", "texels", "ours, s", "rms", "median", "Cycles, s", "rms", "ratio", "at our median", "tuned, s", "rms", "ratio", "at our median", "Embree", "MiB", "Cycles, MiB"]
MODES = ["imported", "tuned"]


def row(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def percent(value):
    return f"{100 * value:.2f} %" if abs(value) < 0.01 else f"{100 * value:.1f} %"


def seconds(value):
    return f"{value:.2f}" if value < 10 else f"{value:.1f}"


def mebibytes(value):
    return f"{value / 2**20:.0f}"


def thousands(value):
    return f"{value:,}".replace(",", " ")


def finished(state):
    """Scenes for which both bakers have figures, each with its verdicts."""
    done = []
    for name, found in state["scenes"].items():
        if found.get("ours") and all(found["cycles"].get(mode) for mode in MODES):
            ours, runs = list(found["ours"].values()), [list(found["cycles"][mode].values()) for mode in MODES]
            done.append((name, found, [verdict.of_scene(ours, cycles) for cycles in runs]))
    return done


def summary(state):
    """One line a scene, and whether the goals hold."""
    done = finished(state)
    if not done:
        return "No scene was compared."
    machine = state["machine"]
    text = [
        f"Measured in one run on {machine['cpu']} with {machine['threads']} threads. Cycles (Blender 4.5) bakes the very same texels, without",
        "denoiser: as Blender's importer sets a scene up, and tuned by hand (one object, diffuse materials alone). The error is that",
        "of all light against a path tracer at random points of the surfaces, |baked - true| / (true + a tenth of the mean), less",
        "the reference's own noise. Seconds are those of the bakes alone, at an error of 2 %, or that of Cycles at its most samples",
        "where that is larger: ours is the fastest setting at or below it. `at our median` is the ratio of times at the median",
        "error of that setting, beyond what was measured by time ~ error^-2: in most scenes the root mean square is that of a few",
        "points at hard shadows and in crevices that are finer than a texel. `Embree` is the time of a whole bake over that of Embree",
        "for the same rays, on one thread.",
        "",
        row(HEAD),
        row(["---"] * len(HEAD)),
    ]
    text += [line(name, found, judged) for name, found, judged in done]
    text += ["", "; ".join(f"{goal}: {'reached' if holds else '**not reached**'}" for goal, holds in goals(done)) + ". "]
    medians = [[judged[mode]["median_ratio"] for _, _, judged in done] for mode in range(2)]
    text[-1] += f"At our median the geometric mean is {verdict.geometric_mean(medians[0]):.0f}, the least {min(medians[0]):.0f}; against Cycles tuned "
    text[-1] += f"by hand {verdict.geometric_mean(medians[1]):.0f} and {min(medians[1]):.0f}. At equal root mean square against Cycles tuned by hand the geometric mean is {verdict.geometric_mean([tuned['ratio'] for _, _, (_, tuned) in done]):.0f}."
    for mode, index in zip(MODES, range(2)):
        misses = [name for name, _, judged in done if not judged[index]["reached"]]
        if misses:
            text += ["", f"No setting of ours is below the error of Cycles ({mode}) in {', '.join(misses)}: the fastest within"]
            text += ["a tenth of our least error stands there against Cycles at that error."]
    failed = [f"{name} failed: {found['failed']}." for name, found in state["scenes"].items() if found.get("failed")]
    text += [""] + failed if failed else []
    text += ["", "`python3 bevy_plugin/benches/rivals/run.py` measures all of it anew and rewrites this table;"]
    text += ["[every run](bevy_plugin/benches/rivals/results.md)."]
    return "\n".join(text)


def goals(done):
    embree = [found["embree"]["ratio"] for _, found, _ in done if found.get("embree", {}).get("ratio")]
    return verdict.goals([imported["ratio"] for _, _, (imported, _) in done], embree)


def line(name, found, judged):
    ours, runs = judged[0]["ours"], [run for mode in MODES for run in found["cycles"][mode].values()]
    cells = [name, thousands(found["triangles"]), thousands(found["texels"]), f"**{seconds(ours['seconds'])}**", percent(ours["rms"]), percent(ours["p50"])]
    for one in judged:
        cells += [seconds(one["cycles_seconds"]), percent(one["error"]), f"**{ratio(one['ratio'])}**", ratio(one["median_ratio"])]
    embree = found.get("embree", {}).get("ratio")
    cells += [f"{embree:.2f}" if embree else "", mebibytes(ours["peak_memory_bytes"])]
    return row(cells + [mebibytes(max(run["peak_memory_bytes"] for run in runs))])


def ratio(value):
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}"


def every_run(state):
    """All runs of all scenes."""
    head = ["scene", "texels per meter", "baked by", "seconds", "rms", "+-", "median", "95 %", "bias", "estimated rms", "MiB"]
    text = ["# Every run", "", "Written by `run.py`; see the readme for what the columns mean.", "", row(head), row(["---"] * len(head))]
    for name, found in state["scenes"].items():
        runs = [("radiosity, " + key, run) for key, run in found.get("ours", {}).items()]
        for mode in MODES:
            cycles = sorted(found.get("cycles", {}).get(mode, {}).values(), key=lambda run: run["samples"])
            runs += [(f"Cycles, {mode}, {run['samples']} samples", run) for run in cycles]
        for baker, run in runs:
            estimate = percent(run["estimated_rms"]) if "estimated_rms" in run else ""
            cells = [name, f"{found['density']:g}", baker, seconds(run["seconds"])]
            cells += [percent(run[key]) for key in ("rms", "rms_error", "p50", "p95", "bias")]
            text.append(row(cells + [estimate, mebibytes(run["peak_memory_bytes"])]))
    text += ["", "| reference | points | its noise | made by |", "| --- | --- | --- | --- |"]
    for name, found in state["scenes"].items():
        if found.get("ours"):
            run = next(iter(found["ours"].values()))
            text.append(row([name, run["points"], percent(run["noise"]), found["reference"]]))
    return "\n".join(text) + "\n"


def rewrite(readme, content):
    """The text of a readme with `content` between the marks.

    >>> rewrite(f"a {BEGIN} old {END} b", "new") == f"a {BEGIN}\\nnew\\n{END} b"
    True
    """
    before, rest = readme.split(BEGIN)
    return before + BEGIN + "\n" + content + "\n" + END + rest.split(END)[1]
