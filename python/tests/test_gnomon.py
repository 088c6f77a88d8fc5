# SPDX-License-Identifier: Apache-2.0
"""The module as its users have it: arrays and their lifetimes, sentences, threads, Ctrl-C."""
import _thread
import doctest
import gc
import os
import resource
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy

import gnomon

SIZE = (160, 90)
SQUARE = numpy.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], numpy.float32)
HALVES = numpy.array([[0, 1, 2], [0, 2, 3]], numpy.uint32)


def setUpModule():
    global device, cache
    device = gnomon.Device(validation=True)
    cache = tempfile.TemporaryDirectory()


def tearDownModule():
    global device
    device = None
    cache.cleanup()


def truth(scene, **options):
    return gnomon.truth(scene, **{"size": SIZE, "samples": 64, "cache": cache.name, **options})


def render(scene, technique="shadow_map", **options):
    return gnomon.render(scene, technique, **{"size": SIZE, "device": device, **options})


def lid_over_floor():
    lid = numpy.diag([0.5, 1, 0.5, 1])
    lid[1, 3] = 1
    floor = gnomon.Mesh(5 * SQUARE, HALVES)
    return gnomon.scene([floor, gnomon.Mesh(SQUARE, HALVES, transforms=lid)])


class Pictures(unittest.TestCase):
    def test_shapes_and_types(self):
        small = {"kernel": 5, "map_size": 256}
        image = render("contact", "pcf", light="sun", params=small, aovs=["albedo"])
        self.assertEqual(image.visibility.shape, (90, 160))
        self.assertEqual(image.visibility.dtype, numpy.float32)
        self.assertEqual((image.lit.shape, image.lit.dtype), ((90, 160, 3), numpy.float32))
        self.assertEqual((image.picture.shape, image.picture.dtype), ((90, 160, 3), numpy.uint8))
        self.assertEqual((image.primitive.shape, image.primitive.dtype), ((90, 160), numpy.uint32))
        self.assertEqual(set(image.aovs), {"albedo", "depth", "geometric_normal"})
        self.assertEqual(image.technique, "pcf:map_size=256:kernel=5")
        self.assertGreater(image.bytes, 256 * 256 * 4 - 1)
        own = sum(ms for name, ms in image.passes.items() if name.startswith("pcf/"))
        self.assertAlmostEqual(own, image.technique_ms, places=6)
        self.assertTrue(0 < image.visibility.mean() < 1)
        self.assertGreater(image.picture.std(), 10)

    def test_one_image_a_light_and_three_channels_where_the_light_has_an_image(self):
        panel = gnomon.light("rect", position=(1.5, 3.5, 2.5), target=(0, 0.3, 0), image="window")
        lights = ["sun", panel]
        image = render("contact", "light_sampling:samples=4", light=lights, lit=False)
        self.assertEqual([i.shape for i in image.images], [(90, 160), (90, 160, 3)])
        self.assertIsNone(image.lit)
        self.assertIsNone(image.picture)

    def test_a_quality_is_a_technique_with_parameters(self):
        low = ("directional", False, "low")
        wanted = [e["technique"] for e in gnomon.qualities()["entries"]
                  if (e["light"], e["area"], e["level"]) == low]
        image = render("contact", light="sun,angle=0", quality="low")
        self.assertEqual([image.technique], wanted)

    def test_arrays_outlive_what_made_them(self):
        arrays = []
        for _ in range(3):
            image = render("plane")
            arrays += [image.visibility, image.lit, image.aovs["depth"], truth("plane").position]
        copies = [a.copy() for a in arrays]
        del image
        gc.collect()
        junk = [numpy.full(a.shape, 7, a.dtype) for a in arrays]
        for array, copy in zip(arrays, copies):
            numpy.testing.assert_array_equal(array, copy)
            with self.assertRaises(ValueError):
                array[0, 0] = 1
        del junk

    def test_the_bits_of_the_program(self):
        program = os.environ.get("GNOMON_PROGRAM")
        if not program:
            self.skipTest("GNOMON_PROGRAM does not name the program")
        with tempfile.TemporaryDirectory() as folder:
            for technique in ("pcf:kernel=5", "ray_traced"):
                words = f"--technique {technique} --light lamp --camera floor --size 160x90"
                words += f" --aov visibility -o {folder}/a.exr"
                subprocess.run([program, "render", "contact", *words.split()],
                               check=True, capture_output=True)
                image = render("contact", technique, light="lamp", camera="floor")
                visibility = gnomon.read_exr(f"{folder}/a.visibility.exr")
                numpy.testing.assert_array_equal(image.visibility, visibility)
                numpy.testing.assert_array_equal(image.lit, gnomon.read_exr(f"{folder}/a.exr"))

    def test_no_memory_is_lost(self):
        scene, lamp, size = gnomon.load("contact"), gnomon.light("lamp", radius=0.2), (480, 270)

        def work():
            t = truth(scene, light=lamp, size=size, samples=4)
            image = render(scene, "shadow_map:map_size=256", light=lamp, size=size)
            gnomon.compare(image, t, device=device)
            return device.allocated_bytes

        def resident():
            gc.collect()
            with open("/proc/self/statm", encoding="ascii") as f:
                return int(f.read().split()[1]) * resource.getpagesize()

        on_device = [work() for _ in range(16)][-1]
        before = resident()
        self.assertLessEqual([work() for _ in range(48)][-1], on_device)
        # a leak of the smallest array alone would be 24 MiB; the allocator keeps some of what is free
        self.assertLess(resident() - before, 16 << 20)


class Truths(unittest.TestCase):
    def test_a_square_casts_a_square(self):
        above = gnomon.camera(eye=(0, 10, 0.01), target=(0, 0, 0), fov=30)
        noon = gnomon.light("directional", direction=(0, -1, 0), angle=0)
        t = truth(lid_over_floor(), light=noon, camera=above)
        self.assertTrue(t.hard)
        self.assertEqual(t.variance.max(), 0)
        floor = t.primitive < 2
        x, z = t.position[..., 0], t.position[..., 2]
        inside = (abs(x) < 0.49) & (abs(z) < 0.49)
        outside = (abs(x) > 0.51) | (abs(z) > 0.51)
        self.assertTrue((t.mean[floor & inside] == 0).all())
        self.assertTrue((t.mean[floor & outside] == 1).all())
        self.assertEqual(set(numpy.unique(t.primitive)) - {0xffffffff}, {0, 1, 2, 3})

    def test_soft_lights_have_a_variance(self):
        t = truth("balls", light=gnomon.light("lamp", radius=0.4))
        self.assertFalse(t.hard)
        self.assertEqual(t.samples, 64)
        self.assertTrue(((t.mean >= 0) & (t.mean <= 1)).all())
        self.assertGreater(t.variance.max(), 0)

    def test_transmittance_has_colours(self):
        t = truth("stacked_panes", light="sun", transmittance=True)
        self.assertEqual(t.mean.shape, (90, 160, 3))
        self.assertGreater(numpy.ptp(t.mean, axis=2).max(), 0.1)

    def test_ctrl_c_ends_a_long_run(self):
        threading.Timer(0.7, _thread.interrupt_main).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            truth("balls", light=gnomon.light("panel"), size=(1920, 1080), samples=65536)
        self.assertLess(time.monotonic() - begin, 10)


class Comparisons(unittest.TestCase):
    def test_a_technique_its_picture_and_its_numbers_agree(self):
        t = truth("contact", light="sun,angle=0")
        image = render(t.scene, "pcf", light="sun,angle=0", params={"kernel": 5})
        more = {"flip": True, "reference": "shadow_map", "device": device}
        by_name = gnomon.compare("pcf", t, params={"kernel": 5}, **more)
        by_picture = gnomon.compare(image, t, **more)
        self.assertEqual(by_name, by_picture)
        single = {m["id"] for m in gnomon.metrics() if m["hard"]}
        self.assertLessEqual(single, set(by_name))
        self.assertIn("flip", by_name)
        counted = (image.primitive == t.primitive) & (t.primitive != 0xffffffff)
        by_array = gnomon.compare(image.visibility, t, mask=counted, device=device)
        mae = float(abs(image.visibility - t.mean)[counted].mean())
        self.assertAlmostEqual(by_array["mae"], mae, places=6)
        self.assertAlmostEqual(by_array["mae"], by_picture["mae"], places=4)

    def test_the_truth_is_right_and_its_opposite_is_not(self):
        t = truth("contact", light="sun,angle=0")
        self.assertEqual(gnomon.compare(t.mean, t)["mae"], 0)
        self.assertEqual(gnomon.compare(1 - t.mean, t)["wrong_pixels"], 1)
        self.assertEqual(gnomon.compare("ray_traced", t, device=device)["wrong_outside_band"], 0)

    def test_an_error_map_is_a_picture(self):
        t = truth("contact", light="sun,angle=0")
        picture = gnomon.error_map(1 - t.mean, t)
        self.assertEqual(picture.dtype, numpy.uint8)
        self.assertEqual(picture.shape[1:], (160, 3))
        lit = picture[:90][(t.mean == 1) & (t.primitive != 0xffffffff)]
        dark = picture[:90][t.mean == 0]
        self.assertGreater(lit[:, 2].mean(), lit[:, 0].mean())
        self.assertGreater(dark[:, 0].mean(), dark[:, 2].mean())

    def test_flip_of_two_pictures(self):
        image = render("contact", light="sun")
        shown = numpy.clip(image.lit / image.lit.max(), 0, 1)
        mean, picture = gnomon.flip(shown, shown)
        self.assertEqual((mean, picture.shape), (0, (90, 160)))
        self.assertGreater(gnomon.flip(1 - shown, shown)[0], 0.1)


class Arrays(unittest.TestCase):
    def test_placements_materials_and_bounds(self):
        places = numpy.stack([numpy.eye(4), numpy.eye(4)])
        places[:, :3, 3] = [[0, 1, 0], [3, 1, 0]]
        red = gnomon.Material(color=(1, 0, 0))
        floor, lids = gnomon.Mesh(5 * SQUARE, HALVES), gnomon.Mesh(SQUARE, HALVES, red, places)
        scene = gnomon.scene([floor, lids], name="two lids")
        self.assertEqual((scene.name, scene.triangle_count), ("two lids", 6))
        self.assertEqual(scene.bounds, ((-5, 0, -5), (5, 1, 5)))
        above = gnomon.camera(eye=(0, 20, 0.01), target=(0, 0, 0), fov=40)
        image = render(scene, camera=above, aovs="albedo")
        self.assertEqual(set(numpy.unique(image.primitive)) - {0xffffffff}, set(range(6)))
        colors = image.aovs["albedo"][image.primitive == 4]
        self.assertGreater(len(colors), 50)
        self.assertLess(abs(colors - [1, 0, 0]).max(), 0.01)

    def test_arrays_of_any_layout_in_memory(self):
        wide = numpy.zeros((4, 6), numpy.float32)
        wide[:, ::2] = SQUARE
        strided = wide[:, ::2]
        self.assertFalse(strided.flags.c_contiguous)
        scene = gnomon.scene([gnomon.Mesh(strided, HALVES)])
        self.assertEqual(scene.bounds, ((-1, 0, -1), (1, 0, 1)))

    def test_sentences(self):
        scene = lid_over_floor()
        t = truth(scene)
        flat = numpy.eye(4)
        flat[1, 1] = 0
        hole = SQUARE.copy()
        hole[2, 1] = numpy.nan

        def mesh(*arrays, **more):
            return lambda: gnomon.scene([gnomon.Mesh(*arrays, **more)])

        def draw(*words, **more):
            return lambda: gnomon.render(scene, *words, device=device, **more)

        def judge(image, **more):
            return lambda: gnomon.compare(image, t, **more)

        red, half = gnomon.Material(color=(2, 0, 0)), gnomon.Material(alpha="half")
        panel, upright = gnomon.light("rect", width=1), draw(size=(90, 160))()
        cases = [
            (mesh(SQUARE.astype(float), HALVES),
             "vertices of mesh 0 takes N x 3 of float32, not float64; convert it with .astype"),
            (mesh(SQUARE[:, :2], HALVES), "vertices of mesh 0 takes N x 3 of float32, not 4x2"),
            (mesh(SQUARE.tolist(), HALVES), "not a list; numpy.asarray makes one"),
            (mesh(hole, HALVES), "row 2 of vertices of mesh 0 holds nan"),
            (mesh(SQUARE, HALVES.astype(numpy.int64)), "mesh 0 takes N x 3 of uint32, not int64"),
            (mesh(SQUARE, HALVES + numpy.uint32(1)), "index 4 in row 1, but there are 4 vertices"),
            (mesh(SQUARE, HALVES[:0]), "mesh 0 has no triangle"),
            (mesh(SQUARE, HALVES, normals=SQUARE[:3]), "of mesh 0 has 3 rows for 4 vertices"),
            (mesh(SQUARE, HALVES, normals=0 * SQUARE), "normals of mesh 0 has no direction"),
            (mesh(SQUARE, HALVES, transforms=flat), "transforms of mesh 0 flattens the mesh"),
            (mesh(SQUARE, HALVES, transforms=numpy.eye(3)), "4 x 4, or N x 4 x 4"),
            (mesh(SQUARE, HALVES, red), "color of material 0 takes three"),
            (mesh(SQUARE, HALVES, half), "alpha of material 0 is half"),
            (lambda: gnomon.scene([]), "a scene takes one mesh at least"),
            (lambda: gnomon.scene([SQUARE]), "a scene is made of gnomon.Mesh"),
            (lambda: gnomon.load("citadell"), "citadel"),
            (draw("pccf"), "pcf"),
            (draw("pcf", params={"kernal": 3}), "kernel"),
            (draw("pcf", params={"kernel": 5000}), "5000"),
            (draw("pcf", params={"kernel": [3]}), "a number, a truth value or a text"),
            (draw("pcf", quality="high"), "a quality is a technique with its parameters"),
            (draw(quality="hihg"), "high"),
            (draw(light="moon"), "moon"),
            (draw(light=3.0), "a light is a text"),
            (draw(light=panel), "rect"),
            (draw(size=640), "it takes (width, height) in pixels"),
            (draw(size=(640, -1)), "height is -1"),
            (draw(aovs=["colour"]), "there is no further image 'colour'"),
            (lambda: gnomon.truth(scene, samples=0), "samples is 0; it takes a whole number"),
            (lambda: gnomon.truth(scene, light=["sun", "sun"]), "the truth is of one light"),
            (judge(t.mean.astype(float)), "image takes height x width"),
            (judge(t.mean[:8]), "image has 160x8 pixels and 1 channels, the truth 160x90 and 1"),
            (judge(t.mean, mask=t.mean), "mask takes 90 x 160 (height x width) of bool"),
            (judge(upright), "another scene, camera, light or size"),
            (lambda: gnomon.Device("no such device"), "no such device"),
            (lambda: gnomon.read_exr("nowhere.exr"), "nowhere.exr"),
        ]
        for call, sentence in cases:
            with self.subTest(sentence), self.assertRaises(gnomon.Error) as caught:
                call()
            self.assertIn(sentence, str(caught.exception))
        self.assertEqual(gnomon.Error.__module__, "gnomon")


class Threads(unittest.TestCase):
    def test_two_devices_at_once_and_one_shared(self):
        expected = gnomon.render("contact", "pcf", size=SIZE, device=device).visibility
        failures = []

        def draw(own):
            try:
                for _ in range(3):
                    image = gnomon.render("contact", "pcf", size=SIZE, device=own)
                    numpy.testing.assert_array_equal(image.visibility, expected)
            except BaseException as e:  # noqa: B902 (a thread's own would be lost)
                failures.append(e)

        devices = (gnomon.Device(validation=True), device, device)
        threads = [threading.Thread(target=draw, args=(d,)) for d in devices]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])

    def test_the_interpreter_goes_on(self):
        ticks, ended = [], threading.Event()

        def tick():
            while not ended.wait(0.005):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        truth("balls", light=gnomon.light("panel"), size=(640, 360), samples=121)
        took = time.monotonic() - begin
        ended.set()
        thread.join()
        self.assertGreater(len(ticks), 10 * took)

    def test_ctrl_c_ends_a_long_render_and_the_device_stays_good(self):
        before = gnomon.render("contact", size=SIZE, device=device)
        threading.Timer(0.7, _thread.interrupt_main).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            gnomon.render("contact", size=(640, 360), samples=4096, device=device)
        self.assertLess(time.monotonic() - begin, 10)
        after = gnomon.render("contact", size=SIZE, device=device)
        numpy.testing.assert_array_equal(before.lit, after.lit)


class Words(unittest.TestCase):
    def test_catalogues(self):
        ids = {t["id"]: t for t in gnomon.techniques(device)}
        self.assertEqual(ids["shadow_map"]["unavailable"], "")
        size = next(p for p in ids["shadow_map"]["parameters"] if p["name"] == "map_size")
        self.assertEqual((size["default"], size["range"]), (2048, [16, 8192]))
        self.assertIn("citadel", {s["name"] for s in gnomon.scenes()})
        self.assertIn(device.name, {d["name"] for d in gnomon.devices()})
        self.assertIn("mae", {m["id"] for m in gnomon.metrics()})

    def test_examples_in_docstrings(self):
        result = doctest.testmod(gnomon, extraglobs={"gnomon": gnomon, "numpy": numpy},
                                 optionflags=doctest.NORMALIZE_WHITESPACE)
        self.assertGreater(result.attempted, 10)
        self.assertEqual(result.failed, 0)

    def test_the_example(self):
        example = os.environ.get("GNOMON_EXAMPLE")
        if not example:
            self.skipTest("GNOMON_EXAMPLE does not name examples/python/compare.py")
        with open(example, encoding="utf-8") as program:
            body = program.read()
        page = os.path.join(os.path.dirname(example), "..", "..", "docs", "python.md")
        with open(page, encoding="utf-8") as text:
            self.assertIn("".join(body.partition("import gnomon")[1:]), text.read())
        ran = subprocess.run([sys.executable, example], check=True, capture_output=True, text=True)
        lines = ran.stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines],
                         ["shadow_map:map_size=1024", "pcf:kernel=5", "ray_traced"])
        wrong = [float(line.split()[1]) for line in lines]
        self.assertLess(wrong[2], wrong[0])


if __name__ == "__main__":
    unittest.main()
