"""What pip asks to make a wheel (PEP 517): CMake builds the module, and the package is packed as it is installed.

For the system's Python the release build is gone on with; for another one there is a build of its own.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent


def _version():
    return re.search(r"project\(Weft VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def _build():
    """The build folder, with the module built in it."""
    own = os.path.realpath(sys.executable) == os.path.realpath("/usr/bin/python3")
    folder = ROOT / "build" / ("release" if own else f"python-{sysconfig.get_config_var('SOABI')}")
    subprocess.run(["cmake", "--preset", "release", "-B", folder, f"-DPython3_EXECUTABLE={sys.executable}",
                    "-DWEFT_PYTHON=ON"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "weft_python", "weft_program"], cwd=ROOT, check=True)
    return folder


def _metadata(project):
    needs = "".join(f"Requires-Dist: {need}\n" for need in project["dependencies"])
    return (f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {_version()}\nSummary: {project['description']}\n"
            f"Requires-Python: {project['requires-python']}\n{needs}")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    project = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
    folder = _build()
    tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    tag = f"{tag}-{tag}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    about = f"weft-{_version()}.dist-info"
    name = f"weft-{_version()}-{tag}.whl"
    with tempfile.TemporaryDirectory() as there, zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        subprocess.run(["cmake", "--install", folder, "--prefix", there, "--component", "python", "--strip"], check=True)
        (site,) = pathlib.Path(there).rglob("site-packages")
        files = {path.relative_to(site).as_posix(): path.read_bytes() for path in sorted(site.rglob("*")) if path.is_file()}
        files[f"{about}/METADATA"] = _metadata(project).encode()
        files[f"{about}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: weft\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
        record = [f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}"
                  for path, data in files.items()]
        files[f"{about}/RECORD"] = "\n".join([*record, f"{about}/RECORD,,", ""]).encode()
        for path, data in files.items():
            wheel.writestr(path, data)
    return name
