"""What is installed and told of the module: stubs that name what is there, docstrings, site-packages, and words on what is missing."""
import ast
import inspect
import os
import pathlib
import subprocess
import sys
import unittest

import weft
from module import ModuleTest
from program import PROGRAM, SOURCE


class Package(ModuleTest):
    def test_stubs_of_the_core_name_what_it_has(self):
        stub = ast.parse((SOURCE / "python/weft/_weft.pyi").read_text())
        functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
        classes = {node.name: {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
                   for node in stub.body if isinstance(node, ast.ClassDef)}
        values = {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
        there = {name for name in dir(weft._weft) if not name.startswith("__")}
        self.assertEqual(there, functions | classes.keys() | values)
        for name, members in classes.items():
            there = {member for member in dir(getattr(weft._weft, name)) if member in members or not member.startswith("_")}
            self.assertEqual(there, members, name)

    def test_stubs_of_the_package_name_what_it_has(self):
        stub = ast.parse((SOURCE / "python/weft/__init__.pyi").read_text())
        wanted = {}
        for node in stub.body:
            if isinstance(node, ast.FunctionDef):
                wanted[node.name] = node
            elif isinstance(node, ast.ClassDef):
                wanted[node.name] = None
                for part in node.body:
                    if isinstance(part, ast.FunctionDef):
                        wanted[f"{node.name}.{part.name}"] = part
        public = {name for name in weft.__all__ if not inspect.ismodule(getattr(weft, name))}
        self.assertEqual({name for name in wanted if "." not in name}, public)
        for name, node in wanted.items():
            found = weft
            for part in name.split("."):
                found = inspect.getattr_static(found, part) if inspect.isclass(found) else getattr(found, part)
            if isinstance(found, (property, classmethod)):
                found = found.fget if isinstance(found, property) else found.__func__
            if node is not None:
                told = [arg.arg for arg in node.args.args + node.args.kwonlyargs]
                has = [key for key, kind in inspect.signature(found).parameters.items() if kind.kind is not kind.VAR_KEYWORD]
                self.assertEqual(told, has, name)
        for name in public:
            members = {key for key, value in vars(getattr(weft, name)).items()
                       if not key.startswith("_") and (inspect.isfunction(value) or isinstance(value, (property, classmethod)))
                       } if inspect.isclass(getattr(weft, name)) else set()
            if name not in ("Strain", "Intersections"):
                self.assertLessEqual({f"{name}.{key}" for key in members}, wanted.keys())

    def test_everything_public_has_a_docstring(self):
        for name in weft.__all__:
            thing = getattr(weft, name)
            self.assertTrue(inspect.getdoc(thing), name)
            for key, value in vars(thing).items() if inspect.isclass(thing) else ():
                if not key.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    self.assertTrue(inspect.getdoc(value), f"{name}.{key}")

    def test_reference_is_what_the_docstrings_say(self):
        sys.path.insert(0, str(SOURCE / "docs"))
        self.addCleanup(sys.path.pop, 0)
        import python_reference
        self.assertEqual((SOURCE / "docs/python-reference.md").read_text(), python_reference.page(), "renew it: ./dev pages")

    def test_installed_it_is_found_in_site_packages(self):
        build = pathlib.Path(PROGRAM).resolve().parents[1]
        done = subprocess.run(["cmake", "--install", build, "--prefix", self.folder / "there"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        site = self.folder / f"there/lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages"
        installed = {path.relative_to(site) for path in site.rglob("*") if path.is_file()}
        wanted = {path.relative_to(SOURCE / "python") for path in (SOURCE / "python/weft").rglob("*")
                  if path.is_file() and "__pycache__" not in path.parts}
        self.assertEqual({path for path in installed if path.suffix != ".so"}, wanted)
        done = subprocess.run([sys.executable, "-c", "import weft; print(weft.__file__, weft.builtin('sheet', 9).size)"],
                              capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(site)})
        self.assertEqual(done.stdout.split(), [str(site / "weft/__init__.py"), "9"], done.stderr)

    def test_version_is_the_program_s(self):
        self.assertEqual(self.run_weft("--version").stdout, f"weft {weft.__version__}\n")


if __name__ == "__main__":
    unittest.main()
