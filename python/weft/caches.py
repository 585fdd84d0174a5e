"""Point caches: positions of vertices over time."""
from . import _arguments, _weft


def write_pc2(path, positions):
    """Writes a point cache (PC2) as `weft simulate` writes them, one sample a frame, whole or not at all.

    positions: (T, n, 3) [m], written as float32.
    """
    name = _arguments.to_write(path)
    _weft.write_pc2(name, _arguments.sequence(positions, "positions"))


def read_pc2(path, frame_rate=60, clip=""):
    """Reads the motion of a mesh's vertices: .pc2, .mdd, .npz, an animation of a .glb or .gltf file, or numbered meshes
    ("body_%04d.obj").

    frame_rate: of files that count frames, and of the samples taken of an animation [1/s].
    clip: name of the animation; the first if not given.
    Returns positions (T, n, 3) float32 and times (T,) float64 [s], the first 0.
    """
    name = _arguments.path(path)
    if "%" not in name:
        name = _arguments.existing(path)
    rate = _arguments.number(frame_rate, "frame_rate", above=0)
    positions, times, in_frames = _weft.read_point_cache(name, rate, _arguments.word(clip, "clip"))
    return positions, times / rate if in_frames else times
