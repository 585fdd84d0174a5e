"""The contract of fabric: what it prints, what it finds, what it refuses."""
import json
import signal
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest

QUICK = ("--size", "17", "--starts", "1")


class Fabric(ProgramTest):
    def test_bending_becomes_a_material(self):
        done = self.run_weft("fabric", "--mass", "184", "--bending", "23.3,4.3")
        material = json.loads(done.stdout)
        self.assertEqual(material["density"], 0.184)
        self.assertEqual(material["bending"], [23.3e-6, 4.3e-6])
        self.assertEqual(list(material)[:4], ["density", "stretch", "shear", "bending"])
        self.assertIn("mm along the warp", done.stderr)

    def test_one_number_is_for_warp_and_weft(self):
        self.assertEqual(self.run_json("fabric", "--mass", "192", "--bending", "30")["material"]["bending"], 30e-6)

    def test_bending_length_is_that_of_a_cantilever(self):
        report = self.run_json("fabric", "--mass", "150", "--length", "20")
        self.assertAlmostEqual(report["material"]["bending"] / (0.15 * 9.81 * 0.02 ** 3), 1, delta=0.005)
        for length in report["bending_length_mm"]:
            self.assertAlmostEqual(length, 20, delta=0.05)

    def test_a_scene_takes_the_material(self):
        material = self.run_weft("fabric", "--mass", "150", "--length", "20,15", "--quiet", "--json").stdout
        scene = {"cloths": [{"surface": "builtin:sheet", "size": 9, "material": json.loads(material)["material"]}]}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        self.run_weft("simulate", "scene.json", "-o", "out", "--frames", "1")

    def test_drape_finds_the_bending(self):
        report = self.run_json("fabric", "--mass", "192", "--drape", "64.4", *QUICK)
        self.assertAlmostEqual(report["drape"]["coefficient_percent"], 64.4, delta=2)
        self.assertEqual(report["drape"]["starts"], 1)
        for length in report["bending_length_mm"]:
            self.assertGreater(length, 10)
            self.assertLess(length, 60)

    def test_missing_or_ambiguous_words_are_usage_errors(self):
        for words, wanted in ((("--bending", "3"), "fabric: no --mass; the mass of a square metre in grams is wanted"),
                              (("--mass", "100"), "fabric: nothing measured of how it bends; "
                                                  "one of --bending, --length, --drape is wanted"),
                              (("--mass", "100", "--bending", "3", "--drape", "50"),
                               "fabric: --bending and --drape; one of --bending, --length, --drape is wanted")):
            self.assertEqual(self.error_of("fabric", *words, code=2), "weft: error: " + wanted)

    def test_numbers_out_of_range_are_usage_errors(self):
        for words, wanted in ((("--mass", "0", "--bending", "3"), "--mass: '0'; a number above 0 is wanted; see weft fabric --help"),
                              (("--mass", "9", "--bending", "-3"),
                               "fabric: --bending -3; a number > 0 is wanted, or two: WARP,WEFT"),
                              (("--mass", "9", "--length", "3,4,5"),
                               "fabric: --length 3,4,5; a number > 0 is wanted, or two: WARP,WEFT"),
                              (("--mass", "9", "--drape", "100"),
                               "fabric: --drape 100; a percentage between 0 and 100 is wanted")):
            self.assertEqual(self.error_of("fabric", *words, code=2), "weft: error: " + wanted)

    def test_a_drape_out_of_reach_is_refused(self):
        error = self.error_of("fabric", "--mass", "192", "--drape", "0.01", *QUICK, code=3)
        self.assertIn("drape: 0.0 %, which no bending stiffness of cloth gives at 0.192 kg/m^2; one of ", error)

    def test_interrupted_it_ends_soon_with_130(self):
        process = subprocess.Popen([PROGRAM, "fabric", "--mass", "192", "--drape", "60", "--size", "129", "--starts",
                                    "100"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)  # all of it would take far longer
        self.assertEqual((process.returncode, errors), (130, "weft: error: interrupted\n"))


if __name__ == "__main__":
    unittest.main()
