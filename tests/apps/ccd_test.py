"""The contract of weft-ccd: one JSON object, one line for bad files."""
import json
import os
import subprocess
import unittest

from program import SHARED, ProgramTest

WEFT_CCD = os.environ["WEFT_CCD"]
# A vertex falls through a triangle, then one beside it; thirds are no doubles.
FALLS = """0,1,1,1,0,1,{truth}
-1,1,0,1,-1,1,{truth}
1,1,0,1,-1,1,{truth}
0,1,0,1,2,3,{truth}
{x},1,-1,1,0,1,{truth}
-1,1,0,1,-1,1,{truth}
1,1,0,1,-1,1,{truth}
0,1,0,1,2,3,{truth}
"""
HIT = FALLS.format(x=0, truth=1)
MISS = FALLS.format(x=9, truth=0)


class Ccd(ProgramTest):
    def ask(self, *words, code=0):
        done = subprocess.run([WEFT_CCD, *map(str, words)], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def counts(self, *words):
        return json.loads(self.ask(*words).stdout)

    def file(self, text, name="some_vertex-face.csv"):
        path = self.folder / name
        path.write_text(text)
        return path

    def error_of(self, *words, code=3):
        done = self.ask(*words, code=code)
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("weft-ccd: error: "), done.stderr)
        return done.stderr

    def test_counts_all_files_together(self):
        first, second = self.file(HIT + MISS), self.file(HIT, "more_vertex-face.csv")
        counts = self.counts(first, second)
        self.assertEqual(list(counts)[:5], ["queries", "positives", "missed", "false_positives", "seconds"])
        self.assertEqual([counts[key] for key in list(counts)[:4]], [3, 2, 0, 0])
        self.assertEqual(counts["inexact"], 3)

    def test_wrong_truths_are_counted(self):
        wrong = self.file(FALLS.format(x=9, truth=1) + FALLS.format(x=0, truth=0))
        counts = self.counts(wrong)
        self.assertEqual((counts["missed"], counts["false_positives"]), (1, 1))

    def test_what_rounding_hides_is_reported(self):
        # The vertex sinks onto a face at height 1 + 1e-40, which no double tells from 1; it ends 1e-17 above.
        height = f"{10 ** 40 + 1},{10 ** 40}"
        face = "".join(f"{x},1,{height},{z},1,1\n" for x, z in ((-1, -1), (1, -1), (0, 2)))
        text = "0,1,2,1,0,1,1\n" + face + f"0,1,{10 ** 17 + 1},{10 ** 17},0,1,1\n" + face
        counts = self.counts(self.file(text))
        self.assertEqual((counts["missed"], counts["inexact"]), (0, 1))

    def test_shared_queries_are_never_missed(self):
        paths = sorted((SHARED / "ccd").glob("*.csv"))
        if not paths:
            self.skipTest(f"{SHARED / 'ccd'} is not there")
        counts = self.counts(*paths)
        self.assertEqual((counts["queries"], counts["positives"], counts["missed"]), (4884, 225, 0))
        self.assertLessEqual(counts["largest_distance"], counts["tolerance"])

    def test_bad_files_end_with_3_and_one_line(self):
        for text, found in ((HIT[:HIT.rindex("0,1,0,1,2")], ":7: the last query ends after 7 lines"),
                            ("", "is empty"),
                            (HIT.replace("2,3", "2,0", 1), ":4: denominator '0'"),
                            (HIT.replace("2,3", "2,-3", 1), ":4: denominator '-3'"),
                            (HIT.replace("2,3", "nan,3", 1), ":4: 'nan'"),
                            (HIT.replace("2,3", "9" * 400 + ",3", 1), ":4: a coordinate of"),
                            (HIT.replace(",1\n", "\n", 1), ":1: not 7 fields"),
                            (HIT.replace(",1\n", ",2\n", 1), ":1: '2' as truth"),
                            (HIT.replace(",1\n", ",0\n", 1), ":2: the truth changes")):
            with self.subTest(found=found):
                self.assertIn(found, self.error_of(self.file(text)))
        self.assertIn("does not tell", self.error_of(self.file(HIT, "some.csv")))
        self.assertIn("missing_edge-edge.csv", self.error_of("missing_edge-edge.csv"))
        self.error_of(code=2)


if __name__ == "__main__":
    unittest.main()
