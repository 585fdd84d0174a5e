"""What callers give, as the library takes it: arrays of any type and order, paths, threads, progress."""
import errno
import operator
import os
from collections.abc import Mapping

import numpy as np

from . import _weft

_INT32 = np.iinfo(np.int32)
_DEEPEST = 64  # lists within each other


def _numbers(given, what, kinds="fiu"):
    if isinstance(given, np.ma.MaskedArray) and np.ma.is_masked(given):
        raise ValueError(f"{what}: an array without a mask is wanted")
    try:
        array = np.asarray(given)
    except ValueError as error:  # lists of different lengths
        raise ValueError(f"{what}: an array of numbers is wanted, not {given!r:.60}") from error
    if array.dtype.kind not in kinds:
        raise TypeError(f"{what}: an array of numbers is wanted, not of {array.dtype}")
    return array


def _shaped(array, shape, what):
    """The array, which must have this shape; None stands for any length."""
    if array.ndim == len(shape) and all(want in (None, has) for has, want in zip(array.shape, shape)):
        return array
    wanted = ", ".join("n" if want is None else str(want) for want in shape)
    raise ValueError(f"{what}: an array of shape ({wanted}{',' if len(shape) == 1 else ''}) is wanted, not {array.shape}")


def vertices(given, what="V"):
    """(n, 3) float64, C-contiguous: a copy, which does not follow what the caller does to its own."""
    return np.array(_shaped(_numbers(given, what), (None, 3), what), dtype=np.float64, order="C")


def _whole(array, what):
    if array.dtype.kind == "f" and not np.array_equal(array, np.floor(array)):
        raise ValueError(f"{what}: whole numbers are wanted")
    if array.size and not (_INT32.min <= array.min() and array.max() <= _INT32.max):
        raise ValueError(f"{what}: an index is beyond 32 bits")
    return np.array(array, dtype=np.int32, order="C")


def faces(given, what="F"):
    """(m, 3) int32, C-contiguous: a copy."""
    return _whole(_shaped(_numbers(given, what), (None, 3), what), what)


def texture(given, face_count, what="uv"):
    """(m, 3, 2) float32 of the corners of faces, finite; or None."""
    if given is None:
        return None
    with np.errstate(over="ignore"):
        array = np.array(_shaped(_numbers(given, what), (face_count, 3, 2), what), dtype=np.float32, order="C")
    if not np.isfinite(array).all():
        raise ValueError(f"{what}: face {np.argwhere(~np.isfinite(array))[0][0]} has a number that is not finite")
    return array


def sequence(given, what):
    """(T, n, 3) float32, finite."""
    array = _shaped(_numbers(given, what), (None, None, 3), what)
    if 0 in array.shape:
        raise ValueError(f"{what}: at least one frame and one point are wanted, not {array.shape}")
    with np.errstate(over="ignore"):
        array = np.array(array, dtype=np.float32, order="C")
    if not np.isfinite(array).all():
        frame, point, _ = (int(k) for k in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{what}: point {point} of frame {frame} is not finite")
    return array


def vector(given, what, length=3):
    """A list of finite floats."""
    array = _shaped(_numbers(given, what), (length,), what).astype(float)
    if not np.isfinite(array).all():
        raise ValueError(f"{what}: finite numbers are wanted, not {array.tolist()}")
    return array.tolist()


def number(given, what, above=None, least=None):
    """A finite float, above one limit or no less than another."""
    try:
        value = float(given)
    except (TypeError, ValueError):
        raise TypeError(f"{what}: a number is wanted, not {given!r:.60}") from None
    if not np.isfinite(value) or (above is not None and value <= above) or (least is not None and value < least):
        limit = f" above {above}" if above is not None else f" of at least {least}" if least is not None else ""
        raise ValueError(f"{what}: a finite number{limit} is wanted, not {value}")
    return value


def integer(given, what, least, most):
    """An int of a range."""
    try:
        value = operator.index(given)
    except TypeError:
        raise TypeError(f"{what}: a whole number is wanted, not {given!r:.60}") from None
    if not least <= value <= most:
        raise ValueError(f"{what}: a number from {least} to {most} is wanted, not {value}")
    return value


def size(given, what="size"):
    """Samples a side."""
    return integer(given, what, _weft.min_image_size, _weft.largest_image_size)


def choice(given, what, names):
    """One of some words."""
    if given not in names:
        raise ValueError(f"{what}: one of {', '.join(map(repr, names))} is wanted, not {given!r:.60}")
    return given


def threads(given):
    """How many threads; None: as many as the machine has for this process, 8 at most."""
    if given is None:
        return max(1, min(8, len(os.sched_getaffinity(0))))
    return integer(given, "threads", 1, 256)


def path(given, what="path"):
    """A path as text."""
    try:
        name = os.fsdecode(given)
    except TypeError:
        raise TypeError(f"{what}: a path is wanted, not {given!r:.60}") from None
    if "\0" in name:
        raise ValueError(f"{what}: a path without null bytes is wanted, not {name!r:.60}")
    return text(name, what)


def text(given, what):
    """Text that is UTF-8."""
    try:
        given.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{what}: a name in UTF-8 is wanted, not {given!r:.60}") from None
    return given


def flag(given, what):
    if not isinstance(given, (bool, np.bool_)):
        raise TypeError(f"{what}: True or False is wanted, not {given!r:.60}")
    return bool(given)


def entries(given, what):
    """A copy of a list of dictionaries, as `plain`; None is an empty one."""
    try:
        listed = [] if given is None else list(given)
    except TypeError:
        raise TypeError(f"{what}: a list of dictionaries is wanted, not {given!r:.60}") from None
    return plain(listed, what)


def plain(given, what, depth=0):
    """A copy of what scene files hold: numbers, texts, lists and dictionaries. Errors name the place in it.

    depth: of the lists and dictionaries that hold it, as one that holds itself would have no end.
    """
    if isinstance(given, (np.ndarray, np.generic)):
        given = given.tolist()
    if isinstance(given, (Mapping, list, tuple)):
        if depth == _DEEPEST:
            raise ValueError(f"{what:.80}: {_DEEPEST} lists and dictionaries within each other at most are wanted, not more")
        if isinstance(given, Mapping):
            return {word(key, f"{what}: a key"): plain(value, f"{what}.{key}", depth + 1) for key, value in given.items()}
        return [plain(value, f"{what}[{index}]", depth + 1) for index, value in enumerate(given)]
    if isinstance(given, str):
        return text(given, what)
    if not (given is None or isinstance(given, (int, float))):
        raise TypeError(f"{what}: a number, a text, a list or a dictionary is wanted, not {given!r:.60}")
    if isinstance(given, float) and not np.isfinite(given):
        raise ValueError(f"{what}: a finite number is wanted, not {given}")
    return given


def name(given):
    """A name in UTF-8; empty where none is given."""
    return "" if given is None else text(word(given, "name"), "name")


def word(given, what):
    if not isinstance(given, str):
        raise TypeError(f"{what}: a text is wanted, not {given!r:.60}")
    return given


def existing(given, what="path"):
    """The path of a file that is there, as text. Raises FileNotFoundError, IsADirectoryError."""
    name = path(given, what)
    if not os.path.exists(name):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), name)
    if os.path.isdir(name):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), name)
    return name


def to_write(given, what="path"):
    """The path of a file in a folder that is there, as text. Raises FileNotFoundError."""
    name = path(given, what)
    folder = os.path.dirname(name) or "."
    if not os.path.isdir(folder):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), folder)
    return name


def progress(given):
    """None or a callable of (stage, fraction). Of a bar like tqdm's, with ``n``, ``total`` and ``update``, one is made."""
    if given is None or callable(given):
        return given
    if not (hasattr(given, "update") and hasattr(given, "n")):
        raise TypeError(f"progress: a callable or a bar like tqdm's is wanted, not {given!r:.60}")

    def show(stage, fraction):
        if hasattr(given, "set_description"):
            given.set_description(stage, refresh=False)
        given.update(fraction * (getattr(given, "total", None) or 1) - given.n)
    return show
