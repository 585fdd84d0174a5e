#!/usr/bin/env python3
"""The paper's Figure 5: its methods and multigrid on the same falling cloths, their times and errors.

Usage: bench/table5.py [--write]
"""
import argparse
import sys

import program

COLUMNS = ("cloth", "n_g, n_l", "W_g, W_l s", "two_level ms", "in 2007 s", "faster", "desbrun: W s", "ms",
           "over two_level", "multigrid ms", "over two_level", "RMS error: two_level m", "desbrun m", "multigrid m")


def row_of(row):
    step = row["integration_s"]
    return [f"{row['n']} x {row['n']}", f"{row['ng']}, {row['nl']}",
            f"{row['precompute_wg_s']:.1e}, {row['precompute_wl_s']:.1e}", f"{1e3 * step:.4f}",
            row["paper_integration_s"], f"{row['paper_integration_s'] / step:.0f}",
            f"{row['desbrun_precompute_s']:.2g}", f"{1e3 * row['desbrun_integration_s']:.3f}",
            f"{row['desbrun_integration_s'] / step:.1f}", f"{1e3 * row['multigrid_integration_s']:.4f}",
            f"{row['multigrid_integration_s'] / step:.2f}",
            *(f"{row['rms_error_' + method]:.1e}" for method in ("two_level", "desbrun", "multigrid"))]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--write", action="store_true", help="renew the table of docs/measured.md")
    options = words.parse_args()
    report, error = program.run("table5", "--full")
    if error:
        sys.exit(f"bench: error: {error}")
    sizes = ", ".join(f"{1e3 * size['multigrid_integration_s']:.3f} ms on {size['n']} x {size['n']}"
                      for size in report["multigrid_sizes"])
    text = program.table(COLUMNS, map(row_of, report["rows"])) + f"\n`multigrid` where the image halves to the end: {sizes}.\n"
    print(text)
    if options.write:
        program.write_between_marks("docs/measured.md", "table5", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
