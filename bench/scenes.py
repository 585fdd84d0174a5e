#!/usr/bin/env python3
"""Runs every scene of examples/scenes and of a shared folder, and drapes a sheet over shared meshes, each step verified; draws
each last frame.

Usage: bench/scenes.py [--frames N] [--threads N] [--minutes N] [--shared FOLDER] [--pictures FOLDER] [--write] [NAME ...]
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import program

MESHES = ("ode_spot.obj", "c3d_rocker-arm.obj", "igl_fertility.off", "bff_kitten.obj", "ode_human_woman.obj")
COLUMNS = ("scene", "samples", "frames", "intersections, worst frame", "strain p99 %, worst frame", "last", "largest %, worst frame",
           "last", "energy gained, m g L", "fell back, worst frame", "ms a frame", "p95", "worst", "solve", "collide", "limit",
           "contacts", "self contacts", "fall of the centre, m", "its way in the last second, mm", "wall time, s")


def scenes(folder, shared):
    """Name and the words that run it; what is generated goes into the folder."""
    made = pathlib.Path(folder)
    for path in sorted((shared / "scenes").glob("*.json")):
        yield path.stem, ("simulate", path)
    for path in sorted((program.ROOT / "examples/scenes").glob("*.json")):
        for maker, file in (("walk.py", "walk.pc2"), ("make_walker.py", "figure.glb")):
            if file in path.read_text():
                subprocess.run([sys.executable, program.ROOT / "examples" / maker, made / file, "--weft", program.PROGRAM],
                               check=True)
                text = path.read_text().replace('"../', f'"{program.ROOT}/examples/')
                path = made / path.name
                path.write_text(text)
        yield path.stem, ("simulate", path)


def drapes(meshes):
    for name in MESHES:
        yield f"sheet on {name}", ("drape", "builtin:sheet", meshes / name)


def verified(words, minutes):
    """(report, None), also where intersections were found; or (None, the error in one line)."""
    try:
        done = subprocess.run([program.PROGRAM, *map(str, words), "--verify", "--json", "--quiet"],
                              capture_output=True, text=True, timeout=60 * minutes)
    except subprocess.TimeoutExpired:
        return None, f"not done in {minutes:g} min"
    if done.returncode in (0, 4):
        return json.loads(done.stdout), None
    return None, f"exit {done.returncode}: {done.stderr.strip().removeprefix('weft: error: ')}"


def way_in_last_second(centres, time_step, substeps):
    frames = round(1 / (time_step * substeps))
    before, after = centres[max(0, len(centres) - 1 - frames)], centres[-1]
    return sum((a - b) ** 2 for a, b in zip(after, before)) ** 0.5


def row_of(name, words, options, run):
    shutil.rmtree(run, ignore_errors=True)  # or the picture of a scene that fails were that of the last
    began = time.monotonic()
    limits = ["--threads", options.threads] + (["--frames", options.frames] if options.frames else [])
    report, error = verified([*words, "-o", run, *limits, "--checkpoint", 0], options.minutes)
    seconds = time.monotonic() - began
    options.pictures.mkdir(parents=True, exist_ok=True)
    subprocess.run([program.PROGRAM, "render", run, "-o", options.pictures / f"{name.replace(' ', '_')}.png"],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    if error:
        return [name, f"**{error.split('.json: ')[-1]}**"] + [""] * (len(COLUMNS) - 2)
    strain, times, centres = report["strain"], report["ms_per_frame"], report["centre_of_mass"]
    return [name, report["particles"], report["frames"], passing_cell(report),
            f"{100 * program.largest(run, 'strain_p99'):.1f}", f"{100 * strain['p99']:.1f}",
            f"{100 * report['strain_worst']['max']:.0f}", f"{100 * strain['max']:.0f}", f"{report['energy_gained_mgl']:.1e}",
            report["fell_back"]["count"], f"{times['median']:.1f}", f"{times['p95']:.1f}", f"{program.largest(run, 'ms'):.1f}",
            *(f"{times[key]:.1f}" for key in ("solve", "collide", "limit")), report["contacts_max"],
            report["self_contacts_max"], f"{centres[0][1] - centres[-1][1]:.4f}",
            f"{1000 * way_in_last_second(centres, report['time_step'], report['substeps']):.2f}", f"{seconds:.0f}"]


def passing_cell(report):
    """What passes through what: nothing in any frame; of cloths that start tangled, nothing any more since they are apart."""
    crossing, found, apart = report["intersections"], report["intersections_found"], report["untangled_frame"]
    started_tangled = report["start_intersections"]["self"] + report["start_intersections"]["cloths"] > 0
    if started_tangled and apart and found["bodies"] + found["ground"] == 0:
        return f"0 from frame {apart} on; {crossing} before"
    return f"**{crossing}**" if crossing else 0


def options_of():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("names", nargs="*", metavar="NAME", help="only scenes whose name holds one of these")
    words.add_argument("--frames", type=int, help="instead of each scene's own")
    words.add_argument("--threads", type=int, default=2)
    words.add_argument("--minutes", type=float, default=20, help="give up a scene after these")
    words.add_argument("--shared", type=pathlib.Path, default=program.ROOT.parent / "shared", help="with folders meshes and scenes")
    words.add_argument("--pictures", type=pathlib.Path, default=program.ROOT / "out/scenes")
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    return words.parse_args()


def rows_of(options, folder):
    """A row a scene; those that were done when it is interrupted."""
    rows = []
    for name, words in (*scenes(folder, options.shared), *drapes(options.shared / "meshes")):
        if options.names and not any(part in name for part in options.names):
            continue
        try:
            rows.append(row_of(name, words, options, pathlib.Path(folder) / "run"))
        except KeyboardInterrupt:
            return [*rows, ["interrupted here"] + [""] * (len(COLUMNS) - 1)]
        print(*rows[-1], sep="\t", flush=True)
    return rows


def main():
    options = options_of()
    with tempfile.TemporaryDirectory() as folder:
        rows = rows_of(options, folder)
    if options.write:
        program.write_between_marks("docs/measured.md", "scenes", program.table(COLUMNS, rows))
    if any("**" in str(cell) for row in rows for cell in row):
        sys.exit("bench: error: a scene fails")


if __name__ == "__main__":
    main()
