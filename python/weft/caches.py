"""Point caches: positions of vertices over time."""
from . import _arguments, _weft


def write_pc2(path, positions):
    """Writes a point cache (PC2) as `weft simulate` writes them, one sample a frame, whole or not at all.

    positions: (T, n, 3) [m], written as float32.
    """
    name = _arguments.to_write(path)
    _weft.write_pc2(name, _arguments.sequence(positions, "positions"))


def read_pc2(path, frame_rate=60):
    """Reads a point cache, .pc2 or .mdd.

    frame_rate: of files that count frames [1/s].
    Returns positions (T, n, 3) float32 and times (T,) float64 [s], the first 0.
    """
    name = _arguments.existing(path)
    rate = _arguments.number(frame_rate, "frame_rate", above=0)
    positions, times, in_frames = _weft.read_point_cache(name)
    return positions, times / rate if in_frames else times
