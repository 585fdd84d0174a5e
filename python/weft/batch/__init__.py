"""Thousands of jobs: `python3 -m weft.batch JOBS -o DIR` runs conversions, drapes and simulations on all workers of a machine or a cluster.

A job is a command of the program with its options. It is named by a hash of its inputs, its options and Weft's version: what is done
is not done again, and what was killed goes on. docs/batch.md tells of it all.
"""
