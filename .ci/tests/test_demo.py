"""`./motus demo`: its names, and the plan of what is rendered when."""

import itertools
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CLONE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(CLONE / "docs" / "scripts"))

import demo_plan  # noqa: E402  (found by the line above)

LIMIT = 600.0  # seconds for everything
FIRST = 180.0  # seconds until the first still


def scenes(count, stills=3):
    """So many scenes like the first of the demos, with names of their own."""
    first = demo_plan.SCENES[0]
    return tuple(first._replace(name=f"scene{number}", stills=first.stills[:1] * stills) for number in range(count))


class Machine:
    """A clock that goes on by what building a scene, a still 1280 pixels wide, and a frame of a film take."""

    def __init__(self, spent, build, still, frame):
        self.now, self.build, self.still, self.frame = spent, build, still, frame
        self.built, self.stills, self.frames, self.samples, self.first_still = set(), [], 0, 0, None

    def clock(self):
        return self.now

    def show(self, scene):
        if scene.name not in self.built:
            self.built.add(scene.name)
            self.now += self.build

    def render(self, shot, width):
        if shot.still == demo_plan.FILM:
            self.now += 3 * self.frame  # to see what one takes
            self.frames, self.samples = demo_plan.fit_film(shot.end - self.now, self.frame, 4, 24, 96)
            self.now += self.frames * self.frame * self.samples / 4
        else:
            self.now += self.still * (width / 1280.0) ** 2
            self.stills.append((shot.scene.name, shot.still, width))
            self.first_still = self.first_still or self.now

    def run(self, count):
        shots = demo_plan.plan((), self.now, scenes(count))
        demo_plan.follow(shots, 1280, self.clock, self.show, self.render)
        return self


class Names(unittest.TestCase):
    def test_an_unknown_name_is_answered_with_those_there_are(self):
        done = subprocess.run(
            [str(CLONE / "motus"), "demo", "flight", "nonsense"],
            cwd="/",
            text=True,
            check=False,
            timeout=60,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self.assertEqual(done.returncode, 2, done.stdout)
        (sentence,) = done.stdout.splitlines()
        self.assertIn("no demo scene named nonsense", sentence)
        for scene in demo_plan.SCENES:
            self.assertIn(scene.name, sentence)

    def test_names_ask_for_whole_scenes_in_their_order(self):
        shots = demo_plan.plan(("pull", "flight", "pull"), 500.0)
        self.assertEqual(list(dict.fromkeys(shot.scene.name for shot in shots)), ["pull", "flight"])
        for name, group in itertools.groupby(shots, lambda shot: shot.scene.name):
            scene = next(scene for scene in demo_plan.SCENES if scene.name == name)
            group = list(group)
            self.assertEqual([shot.still for shot in group], [*range(len(scene.stills)), demo_plan.FILM])
            self.assertEqual({shot.end for shot in group}, {demo_plan.NEVER})
            self.assertFalse(any(shot.is_optional for shot in group))

    def test_whole_scenes_have_the_full_size_on_a_slow_machine(self):
        machine = Machine(300.0, 60.0, 300.0, 1.0)
        demo_plan.follow(demo_plan.plan(("reach",), 300.0)[:-1], 1280, machine.clock, machine.show, machine.render)
        self.assertEqual(machine.stills, [("reach", still, 1280) for still in range(3)])

    def test_the_list_of_scenes_is_sound(self):
        for key in ("name", "identifier", "label", "description"):
            values = [getattr(scene, key) for scene in demo_plan.SCENES]
            self.assertEqual(len(set(values)), len(values), key)
        for scene in demo_plan.SCENES:
            with self.subTest(scene=scene.name):
                self.assertTrue((CLONE / "addon" / "motus" / "demo" / scene.name / "scene.py").is_file())
                self.assertGreaterEqual(len(scene.stills), demo_plan.STILLS)
                self.assertLess(*scene.film)


class Quick(unittest.TestCase):
    def test_a_scene_is_rendered_whole(self):
        with tempfile.TemporaryDirectory(prefix="motus test ") as folder:
            done = subprocess.run(
                [str(CLONE / "motus"), "demo", "pull", "--quick", "--output", folder],
                cwd="/",
                text=True,
                check=False,
                timeout=600,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
            )
            self.assertEqual(done.returncode, 0, done.stdout)
            sizes = {path.name: path.stat().st_size for path in Path(folder).rglob("pull*.*")}
            scene = next(scene for scene in demo_plan.SCENES if scene.name == "pull")
            for number in range(1, len(scene.stills) + 1):  # a picture of one colour has less than a kilobyte
                self.assertGreater(sizes[f"pull_{number:02d}.png"], 10_000)
            self.assertTrue(sizes.keys() & {"pull.mp4", "pull_0216.png"}, sizes)
            self.assertIn("film of 4 frames", done.stdout)


class Shares(unittest.TestCase):
    def test_every_scene_has_a_still_or_two_and_the_first_one_the_film(self):
        for count in (1, 3, 11, 16, 40):
            with self.subTest(scenes=count):
                shots = demo_plan.plan((), 100.0, scenes(count))
                first, *_, last = shots
                self.assertEqual((first.scene.name, first.still), ("scene0", 0))
                self.assertEqual((last.scene.name, last.still), ("scene0", demo_plan.FILM))
                self.assertEqual(
                    [shot.scene.name for shot in shots if not shot.is_optional and shot is not last],
                    [scene.name for scene in scenes(count)],
                )
                self.assertEqual([shot.still for shot in shots[:-1]], [0, 1] * count)

    def test_scenes_have_equal_shares_of_what_is_left(self):
        for count, spent in itertools.product((1, 3, 11, 16), (0.0, 90.0, 300.0, 1000.0)):
            with self.subTest(scenes=count, spent=spent):
                *stills, film = demo_plan.plan((), spent, scenes(count))
                ends = [spent, *(shot.end for shot in stills[::2])]
                self.assertEqual([shot.end for shot in stills[1::2]], ends[1:])
                shares = [later - earlier for earlier, later in itertools.pairwise(ends)]
                self.assertAlmostEqual(min(shares), max(shares))
                total = film.end - spent
                self.assertAlmostEqual(total, max(demo_plan.TOTAL - spent, demo_plan.LEAST))
                self.assertAlmostEqual(sum(shares), (1.0 - demo_plan.FILM_SHARE) * total)

    def test_a_scene_with_one_still_has_one(self):
        shots = demo_plan.plan((), 0.0, scenes(2, stills=1))
        self.assertEqual([shot.still for shot in shots], [0, 0, demo_plan.FILM])


class Time(unittest.TestCase):
    def test_all_is_done_in_time_however_many_scenes_there_are(self):
        for count, spent, build, still, frame in itertools.product((1, 3, 11, 16), (15.0, 110.0), (2.0, 8.0), (5.0, 20.0), (0.3, 1.5)):
            with self.subTest(scenes=count, spent=spent, build=build, still=still, frame=frame):
                machine = Machine(spent, build, still, frame).run(count)
                self.assertLess(machine.first_still, FIRST)
                self.assertLess(machine.now, LIMIT)
                self.assertEqual({name for name, number, _ in machine.stills if number == 0}, {scene.name for scene in scenes(count)})
                self.assertEqual(machine.stills[0][2], 1280)
                self.assertGreaterEqual(machine.frames, 24)

    def test_time_that_is_there_is_used(self):
        machine = Machine(15.0, 2.0, 5.0, 0.3).run(16)
        self.assertEqual(machine.stills, [(scene.name, still, 1280) for scene in scenes(16) for still in (0, 1)])
        self.assertEqual((machine.frames, machine.samples), (96, 4))

    def test_a_film_has_fewer_samples_before_it_is_cut_short(self):
        fits = demo_plan.fit_film
        self.assertEqual(fits(100.0, 1.0, 4, 24, 96), (96, 4))
        self.assertEqual(fits(100.0, 1.2, 4, 24, 96), (96, 3))
        self.assertEqual(fits(100.0, 2.0, 4, 24, 96), (96, 2))
        self.assertEqual(fits(100.0, 4.0, 4, 24, 96), (50, 2))
        self.assertEqual(fits(-5.0, 4.0, 4, 24, 96), (24, 2))
        self.assertEqual(fits(demo_plan.NEVER, 0.8, 4, 24, 1078), (1078, 4))
        self.assertEqual(fits(demo_plan.NEVER, 60.0, 4, 24, 1078), (1078, 2))
        self.assertEqual(fits(100.0, 1.0, 1, 24, 4), (4, 1))

    def test_stills_are_fewer_and_then_smaller_where_time_is_short(self):
        some = Machine(110.0, 8.0, 10.0, 1.0).run(16)
        self.assertTrue(16 < len(some.stills) < 32, some.stills)
        small = Machine(110.0, 8.0, 20.0, 1.0).run(16)
        self.assertEqual({number for _, number, _ in small.stills[2:]}, {0})
        self.assertLess(min(width for *_, width in small.stills), 1280)
