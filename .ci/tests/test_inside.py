"""Which tests run in which Blenders, and what stands in for one that cannot be had."""

import contextlib
import io
import unittest

import blenders
import inside


def planned(names=(), only=("",), without=()):
    """(Groups, what was said)."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        groups = inside.planned(names, only, lambda name: name not in without)
    return groups, said.getvalue()


class Planned(unittest.TestCase):
    def test_every_blender_is_in_the_plan_and_every_release_is_tested(self):
        groups, said = planned()
        self.assertEqual({*groups.whole, *groups.window, *groups.smoke}, set(blenders.NAMES))
        self.assertEqual(groups.whole, ["3.4", "4.5-lts", "5.2-lts"])
        self.assertEqual((groups.window, groups.smoke), (["3.4", "5.2"], ["4.2-lts", "4.3", "5.2"]))
        self.assertEqual((groups.missing, said), ([], ""))
        lists = groups.lists()
        self.assertEqual(lists["WHOLE"], "blender 3.4;official 4.5-lts;official 5.2-lts")
        self.assertEqual((lists["NEWEST"], lists["EXTENSIONS"]), ("5.2-lts", "4.2-lts;4.3;4.5-lts;5.2;5.2-lts"))

    def test_without_official_blenders_debians_run_everything(self):
        groups, said = planned(without=("4.2-lts", "4.5-lts", "5.2-lts"))
        self.assertEqual(groups.whole, ["3.4", "4.3", "4.5-lts", "5.2", "5.2-lts"])
        self.assertEqual((groups.smoke, groups.missing), (["4.2-lts"], ["4.2-lts", "4.5-lts", "5.2-lts"]))
        self.assertEqual(groups.lists()["NEWEST"], "5.2", "one that is there runs what is the same in every Blender")
        for line in ("4.3 runs the whole suite, in the stead of 4.5-lts", "5.2 runs the whole suite, in the stead of 5.2-lts"):
            self.assertIn(line, said)

    def test_who_is_named_runs_everything(self):
        for names, whole, window in (
            (["5.2"], ["5.2"], ["5.2"]),
            (["4.2-lts", "4.9"], ["4.2-lts", "4.9"], ["4.9"]),
            (["4.5-windows"], ["4.5-windows"], []),
            (blenders.NAMES, list(blenders.NAMES), list(blenders.PROGRAMS)),
        ):
            groups, said = planned(names, without=("5.2-lts",))
            self.assertEqual((groups.whole, groups.window, groups.smoke, said), (whole, window, [], ""))

    def test_groups_are_chosen_by_parts_of_their_names(self):
        for only, whole, window in (
            (["blender 5.2"], ["5.2"], []),
            (["official 4.2", "window 4"], ["4.2-lts"], ["4.3"]),
            (["command"], [], []),
        ):
            groups, _ = planned(only=only)
            self.assertEqual((groups.whole, groups.window, groups.smoke), (whole, window, []))

    def test_only_what_is_run_is_looked_for(self):
        """Looking for a Blender may install it."""
        asked = []
        inside.planned((), ["library", "window 3.4"], lambda name: asked.append(name) or True)
        self.assertEqual(asked, ["3.4"])


class Table(unittest.TestCase):
    def test_each_blender_runs_something_and_a_module_has_no_window(self):
        for one in blenders.BLENDERS:
            self.assertTrue(one.tests)
            if one.kind != "program":
                self.assertNotIn("window", one.tests)
                self.assertRegex(one.version, rf"^{one.name.partition('-')[0]}\.\d+$")

    def test_everything_that_pip_installs_has_its_version_and_checksum(self):
        for one in blenders.BLENDERS:
            lines = one.requirements.read_text(encoding="utf-8").splitlines() if one.kind != "program" else ()
            for line in lines:
                self.assertRegex(line, r"^(#.*|[a-z_]+==[0-9.]+ --hash=sha256:[0-9a-f]{64})$")
