"""Pages that follow the program: they hold its own help, every field of its JSON, and every key of scene files."""
import importlib.util
import json
import unittest

from program import PROGRAM, ProgramTest, SOURCE


def load_pages():
    spec = importlib.util.spec_from_file_location("pages", SOURCE / "docs/pages.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def keys_of(report):
    """All keys of an object, also of objects inside; what lists hold is not looked at."""
    for key, value in report.items():
        yield key
        if isinstance(value, dict):
            yield from keys_of(value)


class Commands(ProgramTest):
    pages = load_pages()

    def test_every_command_has_a_page_with_its_own_help(self):
        self.assertGreater(len(self.pages.commands(PROGRAM)), 8)
        outdated = [path.name for path in self.pages.outdated(PROGRAM)]
        self.assertEqual(outdated, [], "./dev pages renews them")

    def test_the_page_of_scene_files_has_every_key(self):
        text = (SOURCE / "docs/scene.md").read_text()
        self.assertEqual(self.pages.scene_with_keys(text), text, "./dev pages renews it")
        schema = json.loads((SOURCE / "docs/scene.schema.json").read_text())
        for part in (schema, *schema["$defs"].values()):
            for key in part.get("properties", {}):
                self.assertIn(f"| `{key}` |", text)

    def test_a_page_that_differs_is_found(self):
        page = self.folder / "shapes.md"
        text = (SOURCE / "docs/commands/shapes.md").read_text()
        self.assertEqual(self.pages.renewed(text, PROGRAM), text)
        page.write_text(text.replace("--output", "--outcome", 1))
        self.assertEqual(self.pages.renewed(page.read_text(), PROGRAM), text)

    def test_the_first_page_lists_every_command_and_no_other(self):
        text = (SOURCE / "docs/commands.md").read_text()
        linked = [line.split("`")[1] for line in text.splitlines() if line.startswith("| [`")]
        self.assertEqual(linked, self.pages.commands(PROGRAM))
        self.assertEqual({path.stem for path in (SOURCE / "docs/commands").glob("*.md")}, set(linked))

    def assert_named(self, command, report):
        page = (SOURCE / f"docs/commands/{command}.md").read_text()
        missing = [key for key in keys_of(report) if f"`{key}`" not in page]
        self.assertEqual(missing, [], f"docs/commands/{command}.md")

    def test_every_field_of_the_reports_is_on_its_page(self):
        self.assert_named("convert", self.run_json("convert", "builtin:sphere", "-o", "ball.exr", "--size", "17"))
        self.assert_named("inspect", self.run_json("inspect", "builtin:sphere"))
        self.assert_named("inspect", self.run_json("inspect", "ball.exr", "--against", "builtin:sphere"))
        self.assert_named("rebuild", {"input": {}, "image": {}, "outputs": []} | {
            key: None for key in self.run_json("rebuild", "ball.exr", "-o", "ball.obj")})
        self.assert_named("simulate", self.run_json("drape", "builtin:sheet", "ball.exr", "-o", "run", "--size", "17",
                                                    "--frames", "1"))
        self.assert_named("render", self.run_json("render", "ball.exr", "-o", "ball.png"))
        self.assert_named("fabric", self.run_json("fabric", "--mass", "150", "--length", "20"))

    def test_reports_are_one_object_each(self):
        done = self.run_weft("shapes", "--json")
        self.assertIn("shapes", json.loads(done.stdout))


if __name__ == "__main__":
    unittest.main()
