#!/usr/bin/env python3
"""Lists the measured blocks of docs/ that have to be measured anew, and why; exits with 1 where there is any.

Usage: bench/stale.py [--root FOLDER] [--most COMMITS]
"""
import argparse
import pathlib
import sys

import stamp

NO_HISTORY = 77  # as tests that are skipped end


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--root", type=pathlib.Path, default=stamp.ROOT)
    words.add_argument("--most", type=int, default=stamp.MAX_COMMITS,
                       help="commits that may change a block's sources before it is stale")
    options = words.parse_args()
    if stamp.git("rev-parse", "--is-shallow-repository", root=options.root) != "false":
        print("bench: skipped: no whole history of commits here to count in")
        return NO_HISTORY
    found = list(stamp.findings(options.root, options.most))
    stale = [finding for finding in found if finding.reason]
    for finding in stale:
        print(f"{finding.document}: {finding.name}: {finding.reason}")
    print(f"bench: {len(stale)} of {len(found)} measured blocks are stale")
    return 1 if stale or not found else 0


if __name__ == "__main__":
    sys.exit(main())
