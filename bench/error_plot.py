#!/usr/bin/env python3
"""Draws docs/figures/error_over_time.png and error_over_time_fabrics.png from the tables error_129 and error_fabrics of
docs/measured.md.

Usage: bench/error_plot.py
"""
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

ROOT = Path(__file__).resolve().parent.parent
TIME, ERROR = "ms a frame", "off by, mm"


def tables_of(document, name):
    """The title and the rows of each table of the block, the rows as dictionaries."""
    block = document.split(f"<!-- {name} -->")[1].split(f"<!-- /{name} -->")[0]
    tables, title = [], ""
    for line in block.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|"):
            title = line or title
        elif line.startswith("| method"):
            tables.append((title, cells, []))
        elif not line.startswith("|---"):
            tables[-1][2].append(dict(zip(tables[-1][1], cells)))
    return [(title, rows) for title, _, rows in tables]


def curves_of(rows):
    """Milliseconds and millimetres of every method that ran, one curve for each number of iterations."""
    curves = {}
    for row in rows:
        if row[TIME] == "unstable":
            continue
        name = " ".join(word for word in (row["method"], row["iterations"]) if word)
        curves.setdefault(name, []).append((float(row[TIME]), float(row[ERROR])))
    return curves


def draw_curves(axes, curves):
    colours = plt.get_cmap("tab20").colors
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


def draw(panels, path):
    """Pictures of curves side by side, each under its title."""
    figure, row = plt.subplots(1, len(panels), figsize=(9.6 if len(panels) == 1 else 5.2 * len(panels), 6.0), dpi=100,
                               sharey=True, squeeze=False)
    for axes, (title, curves) in zip(row[0], panels):
        draw_curves(axes, curves)
        axes.set_title(title)
    row[0][0].set_ylabel("off by mm (rms of 30 frames)")
    row[0][-1].legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
    figure.savefig(path, bbox_inches="tight", metadata={"Software": None})


def main():
    document = (ROOT / "docs/measured.md").read_text()
    for name, picture in (("error_129", "error_over_time.png"), ("error_fabrics", "error_over_time_fabrics.png")):
        panels = [(title.split(",")[0], curves_of(rows)) for title, rows in tables_of(document, name)]
        draw(panels, ROOT / "docs/figures" / picture)


if __name__ == "__main__":
    main()
