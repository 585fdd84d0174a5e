"""Errors of Weft. Each is one line that says where, what was found and what is wanted, which are fields, too."""


class Error(Exception):
    """Every error of the library.

    Fields: ``where`` (a file, FILE:LINE, a key of the scene, or empty), ``found``, ``wanted`` (texts, may be empty).
    """

    def __init__(self, message, where="", found="", wanted=""):
        super().__init__(message)
        self.where, self.found, self.wanted = where, found, wanted

    def __reduce__(self):
        return _again, (type(self), self.args, self.__dict__)


def _again(kind, args, fields):
    """An error from its parts: as it travels between processes."""
    error = kind.__new__(kind, *args)
    error.__dict__.update(fields)
    return error


class UsageError(Error, ValueError):
    """An argument that no call can have: a size out of range, an unknown shape, another ending of a file's name."""


class InputError(Error):
    """A mesh, image or file that is not what it should be: an index out of range, a number that is not finite, a damaged file."""


class OutputError(Error):
    """A place that cannot be written."""


class TopologyError(Error):
    """A mesh whose surface cannot become the image that is asked for."""


class SceneError(Error):
    """A scene with an unknown key, a value out of range, or settings that do not go together."""


class Unstable(SceneError):
    """A cloth that ran away.

    Fields besides those of Error: ``frame`` (from 1), ``cloth`` (its name), ``sample`` (row, column; None where no
    single one tells). The simulation stands at the frame before.
    """

    def __init__(self, message, frame=0, cloth="", sample=None, **fields):
        super().__init__(message, **fields)
        self.frame, self.cloth, self.sample = frame, cloth, sample
