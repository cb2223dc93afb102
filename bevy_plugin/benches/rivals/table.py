"""What was measured as Markdown: the summary in the readme, and every run in a file beside the scripts."""

import verdict

BEGIN, END = "<!-- rivals:begin -->", "<!-- rivals:end -->"
HEAD = ["scene", "triangles", "texels", "radiosity, s", "rms", "Cycles, s", "rms", "ratio", "Embree, same rays", "MiB", "Cycles, MiB"]


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
    """Scenes for which both bakers have figures, each with its verdict."""
    both = [(name, found) for name, found in state["scenes"].items() if found.get("ours") and found.get("cycles")]
    return [(name, found, verdict.of_scene(list(found["ours"].values()), list(found["cycles"].values()))) for name, found in both]


def summary(state):
    """One line a scene, and whether the goals hold."""
    done = finished(state)
    if not done:
        return "No scene was compared."
    machine = state["machine"]
    text = [
        f"Measured in one run on {machine['cpu']} with {machine['threads']} threads. Both bake the same texels, without denoiser;",
        "the error is that of all light against a path tracer at random points of the surfaces, |baked - true| / (true + a tenth",
        "of the mean), less the reference's own noise. Seconds are those of the bakes alone: ours is the fastest setting at or",
        "below 2 %, or below the error of Cycles at its most samples where that is larger; Cycles' is its time at that error.",
        "Embree gets the very rays of our bake on one thread: our time for all of the bake over its time for the rays.",
        "",
        row(HEAD),
        row(["---"] * len(HEAD)),
    ]
    text += [line(name, found, judged) for name, found, judged in done]
    ratios = [judged["ratio"] for _, _, judged in done]
    embree = [found["embree"]["ratio"] for _, found, _ in done if found.get("embree")]
    text += ["", "; ".join(f"{goal}: {'reached' if holds else '**not reached**'}" for goal, holds in verdict.goals(ratios, embree)) + "."]
    misses = [name for name, _, judged in done if not judged["reached"]]
    if misses:
        text += ["", f"No setting of ours is below Cycles' error in {', '.join(misses)}: its best stands against Cycles at that error."]
    text += [f"{name} failed: {found['failed']}." for name, found in state["scenes"].items() if found.get("failed")]
    text += ["", "`bevy_plugin/benches/rivals/run.py` measures all of it anew and rewrites this table; "]
    text[-1] += "[every run](bevy_plugin/benches/rivals/results.md)."
    return "\n".join(text)


def line(name, found, judged):
    ours, cycles = judged["ours"], list(found["cycles"].values())
    embree = f"{found['embree']['ratio']:.2f}" if found.get("embree") else ""
    cells = [name, thousands(found["triangles"]), thousands(found["texels"]), f"**{seconds(ours['seconds'])}**", percent(ours["rms"])]
    cells += [seconds(judged["cycles_seconds"]), percent(judged["error"]), f"**{judged['ratio']:.0f}**", embree]
    memory = max(run["peak_memory_bytes"] for run in cycles)
    return row(cells + [mebibytes(ours["peak_memory_bytes"]), mebibytes(memory)])


def every_run(state):
    """All runs of all scenes."""
    head = ["scene", "texels per meter", "baked by", "seconds", "rms", "+-", "median", "95 %", "bias", "estimated rms", "MiB"]
    text = ["# Every run", "", "Written by `run.py`; see the readme for what the columns mean.", "", row(head), row(["---"] * len(head))]
    for name, found in state["scenes"].items():
        runs = [("radiosity, " + key, run) for key, run in found.get("ours", {}).items()]
        runs += [(f"Cycles, {run['samples']} samples", run) for run in sorted(found.get("cycles", {}).values(), key=lambda run: run["samples"])]
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
