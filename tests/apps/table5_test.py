"""The contract of table5: rows, fields, what is null."""
import re
import signal
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest

FIELDS = ["n", "particles", "ng", "nl", "precompute_wg_s", "precompute_wl_s", "integration_s", "desbrun_precompute_s",
          "desbrun_integration_s", "multigrid_integration_s", "paper_integration_s", "paper_desbrun_integration_s",
          "rms_error_two_level", "rms_error_desbrun", "rms_error_multigrid"]
SIZES = [11] + 2 * [21] + 3 * [31] + 3 * [41] + 2 * [51] + 3 * [61] + 2 * [71] + 3 * [81]


class Table5(ProgramTest):
    def test_json_has_the_19_rows_of_the_paper(self):
        rows = self.run_json("table5", "--frames", "1")["rows"]
        self.assertEqual([row["n"] for row in rows], SIZES)
        for row in rows:
            self.assertEqual(list(row)[:len(FIELDS)], FIELDS)
            self.assertEqual(row["particles"], row["n"] ** 2)
            self.assertEqual((row["n"] - 1) % (row["ng"] - 1), 0)
            for field in FIELDS[:-3]:
                self.assertGreater(row[field], 0, field)
            self.assertEqual([row[field] for field in FIELDS[-3:]], [None] * 3)
        self.assertEqual((rows[-1]["ng"], rows[-1]["nl"], rows[-1]["paper_integration_s"]), (41, 5, 0.932329))

    def test_text_has_two_lines_a_row(self):
        lines = self.run_weft("table5", "--frames", "1").stdout.splitlines()
        named = [line.split(" x ")[0] for line in lines if line[:1].isdigit()]
        sizes = [str(n) for n in sorted(set(SIZES))]
        self.assertEqual(named, sizes + ["17", "33", "65", "129"] + sizes)
        measured = [line for line in lines if re.search(r"\d\.\d", line)]
        self.assertEqual(len(measured), 2 * len(SIZES) + 4)
        self.assertEqual(self.run_weft("table5", "--frames", "1", "--quiet").stdout, "")

    def test_interrupted_it_ends_soon_with_130(self):
        process = subprocess.Popen([PROGRAM, "table5", "--frames", "1000000"], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)  # all of it would take far longer
        self.assertEqual((process.returncode, errors), (130, "weft: error: interrupted\n"))

    def test_words_out_of_range_are_usage_errors(self):
        self.error_of("table5", "--frames", "0", code=2)


if __name__ == "__main__":
    unittest.main()
