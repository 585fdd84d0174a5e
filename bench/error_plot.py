#!/usr/bin/env python3
"""Draws docs/figures/error_over_time.png from the table error_129 of docs/measured.md.

Usage: bench/error_plot.py [-o PNG]
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

ROOT = Path(__file__).resolve().parent.parent
TIME, ERROR = "ms a frame", "off by, mm"


def rows_of(document, name):
    """The rows of the block's table, as dictionaries."""
    block = document.split(f"<!-- {name} -->")[1].split(f"<!-- /{name} -->")[0]
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines() if line.startswith("|")]
    return [dict(zip(lines[0], cells)) for cells in lines[2:]]


def curves_of(rows):
    """Milliseconds and millimetres of every method that ran, one curve for each number of iterations."""
    curves = {}
    for row in rows:
        if row[TIME] == "unstable":
            continue
        name = " ".join(word for word in (row["method"], row["iterations"]) if word)
        curves.setdefault(name, []).append((float(row[TIME]), float(row[ERROR])))
    return curves


def draw(curves, path):
    figure, axes = plt.subplots(figsize=(9.6, 6.0), dpi=100)
    colours = plt.get_cmap("tab10").colors
    for index, (name, points) in enumerate(curves.items()):
        is_default = name == "newton"
        axes.plot(*zip(*points), marker="o", markersize=6 if is_default else 4, linewidth=2.5 if is_default else 1.2,
                  color=colours[index % len(colours)], label=name, zorder=3 if is_default else 2)
    for axis, scale in ((axes.xaxis, axes.set_xscale), (axes.yaxis, axes.set_yscale)):
        scale("log")
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(FormatStrFormatter("%g"))
        axis.set_minor_formatter(NullFormatter())
    axes.grid(True, which="major", color="0.88")
    axes.set_axisbelow(True)
    axes.set_xlabel("ms a frame")
    axes.set_ylabel("off by mm (rms of 30 frames)")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
    figure.savefig(path, bbox_inches="tight", metadata={"Software": None})


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("-o", "--picture", default=ROOT / "docs/figures/error_over_time.png")
    options = words.parse_args()
    draw(curves_of(rows_of((ROOT / "docs/measured.md").read_text(), "error_129")), options.picture)


if __name__ == "__main__":
    main()
