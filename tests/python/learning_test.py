"""Arrays for machine learning, read back by numpy alone."""
import functools
import unittest

import numpy as np

import weft
import weft.garmage
import weft.omages
from module import ModuleTest

SHAPES = {"mannequin": "auto", "tshirt": "auto", "double_torus": 6}


@functools.cache
def image_of(shape, size=63, **options):
    V, F = weft.read_mesh(f"builtin:{shape}")
    return weft.geometry_image(V, F, size=size, measure=False, **options)


class Omages(ModuleTest):
    def read(self, name):
        """The array as any program reads it."""
        with np.load(name, allow_pickle=False) as file:
            self.assertEqual(file.files, ["arr_0"])
            return file["arr_0"]

    def test_channels_are_those_of_the_format(self):
        for shape, charts in SHAPES.items():
            image = image_of(shape, charts=charts)
            image.save("object.npz", format="omages", colour=(1, 0.5, 0), metal=0.25, rough=0.75)
            array = self.read("object.npz")
            self.assertEqual((array.dtype, array.shape[0], array.shape[2]), (np.uint16, array.shape[1], 12))
            values = array / 65535
            occupied = values[..., 3] > 0.5
            self.assertEqual(occupied.sum(), sum(chart.rows * chart.cols for chart in image.charts))
            self.assertTrue((array[~occupied] == 0).all())
            points = values[occupied][:, :3] * 2 - 1
            self.assertAlmostEqual(np.ptp(points, axis=0).max(), 2, 4)  # the unit cube is filled along its longest side
            np.testing.assert_allclose(points.min(0) + points.max(0), 0, atol=1e-4)  # and it lies in the middle
            lengths = np.linalg.norm(values[occupied][:, 4:7] * 2 - 1, axis=1)
            np.testing.assert_allclose(lengths, 1, atol=1e-4)
            np.testing.assert_allclose(values[occupied][:, 7:], np.broadcast_to([1, 0.5, 0, 0.25, 0.75], (len(points), 5)), atol=1e-5)

    def test_charts_are_apart_and_nothing_joins_around_the_edge(self):
        for shape, charts in SHAPES.items():
            image = image_of(shape, charts=charts)
            occupied = weft.omages.arrays(image)[..., 3] > 0
            self.assertFalse(occupied[-1].any() or occupied[:, -1].any())
            seen, parts = np.zeros_like(occupied), 0
            for start in zip(*np.nonzero(occupied)):
                if seen[start]:
                    continue
                parts += 1
                todo = [start]
                while todo:
                    row, col = todo.pop()
                    if occupied[row, col] and not seen[row, col]:
                        seen[row, col] = True
                        todo += [((row + i) % len(occupied), (col + k) % len(occupied)) for i in (-1, 0, 1) for k in (-1, 0, 1)]
            self.assertEqual(parts, len(image.charts), shape)

    def test_seams_hold_equal_bits(self):
        for shape, charts in SHAPES.items():
            image = image_of(shape, charts=charts)
            array = weft.omages.arrays(image)
            _, F = weft.omages.to_mesh(array)
            edges = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
            _, counts = np.unique(edges, axis=0, return_counts=True)
            if shape != "tshirt":  # a closed surface stays one
                self.assertLess((counts == 1).sum(), 0.002 * len(counts), shape)
            geometry = weft.omages.arrays(image, geometry_only=True)
            np.testing.assert_array_equal(geometry, array[..., :4])

    def test_normals_point_as_the_surface_does(self):
        V, F = weft.read_mesh("builtin:sphere")
        values = weft.omages.convert(V, F, 64) / 65535
        occupied = values[..., 3] > 0.5
        points, normals = (values[occupied][:, k:k + 3] * 2 - 1 for k in (0, 4))
        self.assertGreater(np.einsum("ij,ij->i", points, normals).min(), 0.98)
        V, F = weft.omages.to_mesh(weft.omages.convert(V, F, 64))
        a, b, c = (V[F[:, k]] for k in range(3))
        self.assertAlmostEqual(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6, 4 / 3 * np.pi, 1)

    def test_sizes_are_those_asked_for(self):
        V, F = weft.read_mesh("builtin:double_torus")
        for size, charts in ((32, "auto"), (64, "auto"), (64, 5), (100, 3)):
            self.assertEqual(weft.omages.convert(V, F, size, charts=charts).shape, (size, size, 12))
        with self.assertRaises(ValueError):
            weft.omages.arrays(image_of("tshirt"), 63)
        with self.assertRaises(weft.InputError):
            weft.omages.convert(V, F, 8, charts=40)

    def test_the_image_of_an_array_has_its_place_and_size(self):
        V, F = weft.read_mesh("builtin:double_torus")
        V = 3 * V + [10, 20, 30]
        image = weft.omages.image(V, F, 64, charts=5)
        array = weft.omages.arrays(image, 64)
        np.testing.assert_array_equal(array, weft.omages.convert(V, F, 64, charts=5))
        own = image.to_mesh()[0]
        low, high = own.min(0), own.max(0)
        back = weft.omages.to_mesh(array)[0] * (high - low).max() / 2 + (low + high) / 2
        # Rounded to 16 bits the vertices are those of the image, in another order.
        np.testing.assert_allclose(np.sort(back, axis=0), np.sort(own, axis=0), atol=(high - low).max() / 65535)

    def test_files_are_read_back_and_others_refused(self):
        image = image_of("tshirt")
        image.save("shirt.npz", format="omages")
        np.testing.assert_array_equal(weft.omages.load("shirt.npz"), weft.omages.arrays(image))
        np.savez("other.npz", arr_0=np.zeros((4, 4, 5), np.uint16))
        (self.folder / "text.npz").write_text("none")
        for name in ("other.npz", "text.npz"):
            with self.assertRaises(weft.InputError):
                weft.omages.load(name)


class Garmage(ModuleTest):
    KEYS = {"surf_wcs", "surf_ncs", "surf_mask", "surf_uv_wcs", "surf_uv_ncs", "surf_normals", "surf_bbox_wcs", "surf_uv_bbox_wcs",
            "global_offset", "global_scale", "uv_offset", "uv_scale"}

    def test_arrays_are_those_of_the_format(self):
        image = image_of("tshirt", charts=4)
        for uniform in (True, False):
            image.save("shirt.npz", format="garmage", resolution=48, uniform=uniform)
            with np.load("shirt.npz", allow_pickle=False) as file:
                found = {key: file[key] for key in file.files}
            self.assertEqual(found.keys(), self.KEYS)
            panels = len(image.charts)
            self.assertGreater(panels, 3)
            for key, width in {"surf_wcs": 3, "surf_ncs": 3, "surf_uv_wcs": 2, "surf_uv_ncs": 2, "surf_normals": 3}.items():
                self.assertEqual((found[key].shape, found[key].dtype), ((panels, 48, 48, width), np.float32), key)
            self.assertEqual((found["surf_mask"].shape, found["surf_mask"].dtype), ((panels, 48, 48, 1), bool))
            self.assertTrue(found["surf_mask"].all())
            world = found["surf_wcs"] * (found["global_scale"] / 2) + found["global_offset"]
            for k, chart in enumerate(image.charts):
                for row, col in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
                    np.testing.assert_allclose(world[k, row, col], chart.positions[row, col], atol=1e-6)
            for key, box, width in (("surf_wcs", "surf_bbox_wcs", 3), ("surf_uv_wcs", "surf_uv_bbox_wcs", 2)):
                flat = found[key].reshape(panels, -1, width)
                np.testing.assert_array_equal(found[box], np.hstack([flat.min(1), flat.max(1)]))
            for key in ("surf_ncs", "surf_uv_ncs"):
                flat = found[key].reshape(panels, -1, found[key].shape[-1])
                np.testing.assert_allclose(np.ptp(flat, axis=1).max(1), 2, atol=1e-5)
                np.testing.assert_allclose(flat.min(1) + flat.max(1), 0, atol=1e-5)
            np.testing.assert_allclose(np.linalg.norm(found["surf_normals"], axis=-1), 1, atol=1e-5)
            if not uniform:
                self.assertAlmostEqual(np.abs(found["surf_wcs"]).max(), 1, 2)

    def test_a_flat_sheet_is_flat_in_its_own_size(self):
        arrays = weft.garmage.arrays(weft.builtin("sheet", size=17), 16)
        flat = arrays["surf_uv_wcs"] * arrays["uv_scale"] / 2
        self.assertAlmostEqual(np.ptp(flat[..., 0]), 1, 5)
        self.assertAlmostEqual(np.ptp(flat[..., 1]), 1, 5)
        np.testing.assert_allclose(np.abs(arrays["surf_normals"][..., 1]), 1, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
