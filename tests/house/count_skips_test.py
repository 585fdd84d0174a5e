"""What tests/house/count_skips.py says between the tests and ctest's summary."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parent / "count_skips.py"
PRINTED = """1/4 Test #1: Maps.Shared ......***Skipped   0.02 sec
2/4 Test #2: Maps.Long ........***Not Run (Disabled)   0.00 sec
3/4 Test #3: Program.Convert ..   Passed    0.61 sec

"""
SUMMARY = """100% tests passed, 0 tests failed out of 4

Total Test time (real) =   0.69 sec
"""
LOG = """1/4 Testing: Maps.Shared
1/4 Test: Maps.Shared
[ RUN      ] Maps.Shared
maps_test.cpp:2: Skipped
no meshes
[  SKIPPED ] Maps.Shared (0 ms)
3/4 Test: Program.Convert
test_a (__main__.Convert.test_a) ... skipped "it's not there"
  test_b (__main__.Convert.test_b) [part] ... skipped 'no meshes'
test_c (__main__.Convert.test_c) ... ok
4/4 Test: House.History
bench: skipped: no whole history
"""


def passed_on(printed, log):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "LastTest.log"
        path.write_text(log)
        return subprocess.run([sys.executable, SCRIPT, path], input=printed, capture_output=True, text=True, check=True).stdout


class CountSkips(unittest.TestCase):
    def test_every_skip_is_counted_by_its_reason_before_the_summary(self):
        text = passed_on(PRINTED + SUMMARY, LOG)
        self.assertTrue(text.startswith(PRINTED))
        self.assertTrue(text.endswith(SUMMARY))
        told = text[len(PRINTED) : -len(SUMMARY)].splitlines()
        self.assertEqual(told[0], "5 tests skipped:")
        self.assertEqual(told[1], "  2: no meshes (Maps.Shared and 1 more)")
        self.assertEqual(set(told[2:]), {"  1: it's not there (Program.Convert)", "  1: no whole history (House.History)",
                                         "  1: long, and left to ./dev bench validate (Maps.Long)", ""})

    def test_no_skip_is_told_as_well(self):
        self.assertEqual(passed_on(SUMMARY, "1/1 Test: Maps.Shared\n"), "0 tests skipped\n\n" + SUMMARY)

    def test_output_without_a_summary_stays_as_it_is(self):
        self.assertEqual(passed_on("ctest: no such folder\n", LOG), "ctest: no such folder\n")


if __name__ == "__main__":
    unittest.main()
