"""Whatever a script does to the outbox of a hub, or writes into a solver's driver, Blender stays alive, and nothing raises."""

import unittest

import support

outbox = support.addon("core.wiring.outbox")
solver = support.addon("core.wiring.solver")

SPOIL = """
import bpy

def longer(value):
    return list(value) * 2 + [0.0]

VALUES = {"deleted": None, "a number": lambda _: 5, "a text": lambda _: "x", "a group": lambda _: {}, "longer": longer}
for name, value in VALUES.items():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.motus.snow_add(preset='GENTLE', rate=20.0, lifetime=2.0, look='POINTS', location=(0.0, 8.0, 5.0))
    for frame in (1, 13, 30):
        bpy.context.object.location.x = frame
        bpy.context.object.keyframe_insert("location", frame=frame)
        bpy.context.scene.frame_set(frame)
    spoilt = 0
    for mesh in bpy.data.meshes:
        for key in [key for key in mesh.keys() if key.endswith("_out")]:
            kept = list(mesh[key])
            del mesh[key]
            spoilt += 1
            if value:
                mesh[key] = value(kept)
    for frame in range(31, 46):
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("x", None))
        bpy.context.view_layer.update()
        bpy.context.scene.frame_set(frame)
    print("ALIVE", name, spoilt, flush=True)
"""
"""Each time an object is linked, Blender builds the relations among what is evaluated anew."""


class HostileTest(unittest.TestCase):
    def test_outbox(self):
        status, said = support.run_blender(SPOIL)
        lines = said.splitlines()
        alive = [line for line in lines if line.startswith("ALIVE")]
        self.assertEqual(alive, [f"ALIVE {name} 1" for name in ("deleted", "a number", "a text", "a group", "longer")],
                         f"status {status}: {lines[-12:]}")
        self.assertFalse([line for line in lines if line.startswith("Traceback")])

    def test_arguments(self):
        damaged = float(outbox.DAMAGED)
        for arguments in ((), (None,), (5, "snow", 1.0, None), (None, "nothing", 1.0, None), (None, 3, 1.0, None),
                          (None, "path", "x", None)):
            self.assertEqual(solver.motus_solve(*arguments), damaged, arguments)
