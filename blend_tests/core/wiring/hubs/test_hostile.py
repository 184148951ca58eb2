"""Whatever a script or the outliner does to what Motus keeps in a file, Blender stays alive, and nothing raises."""

import live_scenes
import support

outbox = support.addon("core.wiring.hubs.outbox")
solver = support.addon("core.wiring.solving.namespace")


class HostileTest(support.SceneTestCase):
    def check(self, keys):
        """keys: whether the acts are those to custom properties."""
        status, said = support.run_blender(
            f"from core.wiring.hubs import hostile_acts\nhostile_acts.run({live_scenes.saved()!r}, {str(self.folder)!r}, {keys})\n"
        )
        lines = said.splitlines()
        acts = [line for line in lines if line.startswith("ACT ")]
        self.assertIn("ALIVE", lines, f"status {status}, after {acts[-1:]}: {lines[-12:]}")
        self.assertGreater(len(acts), 7 if keys else 30)
        told = [line for line in lines if line.startswith(("ACT ", "LOGGED", "Traceback"))]
        wrong = [(told[index - 1], line) for index, line in enumerate(told) if not line.startswith("ACT ")]
        self.assertEqual(wrong, [])

    def test_custom_properties(self):
        self.check(True)

    @support.in_one_blender
    def test_everything_else(self):
        self.check(False)

    def test_arguments(self):
        damaged = float(outbox.DAMAGED)
        for arguments in (
            (),
            (None,),
            (5, "snow", 1.0, None),
            (None, "nothing", 1.0, None),
            (None, 3, 1.0, None),
            (None, "path", "x", None),
        ):
            self.assertEqual(solver.motus_solve(*arguments), damaged, arguments)
