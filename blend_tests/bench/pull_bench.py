"""Pick & Pull against proportional editing and NumPy: a dab, to the evaluated mesh. Run by ./motus bench."""

import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from table import Column, Table  # noqa: E402

import support  # noqa: E402  (found by the line above)

SIDE = 1000
SPACING = 0.01
DABS = 15
SHARES = (0.05, 0.5)
"""Radius as a share of the grid's side."""


def grid():
    """A million vertices, evaluated."""
    support.empty_scene()
    bpy.ops.motus.grid_add(width=SIDE, height=SIDE, spacing=SPACING)
    bpy.context.view_layer.update()
    return bpy.context.object


def median(act, count=DABS, prepare=lambda: None):
    """Milliseconds of act(), which is done once before."""
    prepare()
    act()
    samples = []
    for _ in range(count):
        prepare()
        start = time.perf_counter()
        act()
        samples.append(time.perf_counter() - start)
    return statistics.median(samples) * 1e3


def read(mesh):
    found = np.empty(3 * len(mesh.vertices), np.float32)
    attribute = mesh.attributes.get("position")
    if attribute is not None:
        attribute.data.foreach_get("vector", found)
    else:
        mesh.vertices.foreach_get("co", found)
    return found


def write(mesh, flat):
    attribute = mesh.attributes.get("position")
    if attribute is not None:
        attribute.data.foreach_set("vector", flat)
    else:
        mesh.vertices.foreach_set("co", flat)
    mesh.update()


def update_only(_radius):
    """What Blender itself takes for a mesh that has changed, however that came about: nobody can be faster."""
    obj = grid()
    flat = read(obj.data)

    def act():
        write(obj.data, flat)
        bpy.context.view_layer.update()

    return median(act)


def numpy_dab(radius):
    obj = grid()
    flat = read(obj.data)
    places = flat.reshape(-1, 3)
    root = places[len(places) // 2 + SIDE // 2].copy()

    def act():
        away = places - root
        distances = np.sqrt(np.einsum("ij,ij->i", away, away))
        t = np.maximum(1.0 - distances / radius, 0.0, dtype=np.float32)
        places[:, 2] += 0.001 * (3.0 * t * t - 2.0 * t * t * t)
        write(obj.data, flat)
        bpy.context.view_layer.update()

    return median(act)


def session_of(obj, radius, **changes):
    dab, brush = support.addon("pull.session.dab"), support.addon("pull.brush")
    return dab.Session(bpy.context, obj, brush.Brush(radius=radius, strength=0.001, direction='Z', **changes))


def session_dab(**changes):
    """One dab of a stroke, as the mouse does it: picked by a ray, pulled, evaluated."""

    def measure(radius):
        obj = grid()
        session = session_of(obj, radius, **changes)
        session.begin_stroke()
        places = iter(np.linspace(-0.1, 0.1, 2 * DABS))

        def act():
            hit = session.pick((next(places), 0.0, 5.0), (0.0, 0.0, -1.0))
            session.pull(hit.vertex, session.displacement(hit.vertex))
            bpy.context.view_layer.update()

        return median(act)

    return measure


def scripted(radius):
    """The whole operator: reads the mesh, finds the vertex, pulls, writes."""
    obj = grid()
    root = SIDE * SIDE // 2 + SIDE // 2

    def act():
        bpy.ops.motus.pick_pull(object=obj.name, vertex=root, radius=radius, strength=0.001, direction='Z')
        bpy.context.view_layer.update()

    return median(act)


def proportional(radius):
    obj = grid()
    bpy.ops.object.mode_set(mode='EDIT')
    import bmesh

    edit = bmesh.from_edit_mesh(obj.data)
    edit.verts.ensure_lookup_table()
    for vertex in edit.verts:
        vertex.select_set(False)
    edit.verts[SIDE * SIDE // 2 + SIDE // 2].select_set(True)
    edit.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)

    def act():
        # Without an override: with one onto a viewport, Blender 3.4 and 4.3 crash in the background.
        bpy.ops.transform.translate(
            value=(0.0, 0.0, 0.001), use_proportional_edit=True, proportional_edit_falloff='SMOOTH', proportional_size=radius
        )
        bpy.context.view_layer.update()

    found = median(act, 3)
    bpy.ops.object.mode_set(mode='OBJECT')
    return found


ROWS = (
    ("Blender proportional editing", proportional),
    ("NumPy dab", numpy_dab),
    ("Blender's evaluation alone", update_only),
    ("Motus session, accumulating", session_dab()),
    ("Motus session, from the original", session_dab(accumulate=False)),
    ("Motus session, along the surface", session_dab(distance='SURFACE', accumulate=False)),
    ("motus.pick_pull, scripted", scripted),
)


def report_dabs():
    table = Table(f"A dab on {SIDE * SIDE} vertices to the evaluated mesh", Column("dab", "ms"), Column("of Blender", "x", "9.4f"))
    for share in SHARES:
        reference = None
        for name, measure in ROWS:
            name = f"{name}, radius {share:.0%}"
            with table.guarded(name):
                found = measure(share * SIDE * SPACING)
                reference = reference or found
                table.row(name, found, found / reference)


def report_start():
    obj = grid()
    start = time.perf_counter()
    session = session_of(obj, 0.5)
    opened = time.perf_counter()
    session.pick((0.0, 0.0, 5.0), (0.0, 0.0, -1.0))
    picked = time.perf_counter()
    picking = median(lambda: session.pick((0.1, 0.1, 5.0), (0.0, 0.0, -1.0)), 50)
    start_ray = time.perf_counter()
    obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).ray_cast((0.0, 0.0, 5.0), (0.0, 0.0, -1.0))
    ray = time.perf_counter()
    rows = (
        ("to begin", (opened - start) * 1e3),
        ("first pick, which reads triangles and builds the tree", (picked - opened) * 1e3),
        ("each pick", picking),
        ("Blender's first ray_cast", (ray - start_ray) * 1e3),
    )
    table = Table("What a session takes besides", Column("taken", "ms"), width=52)
    for name, value in rows:
        table.row(name, value)


def report_grid():
    support.empty_scene()
    bpy.ops.motus.grid_add(width=4, height=4)

    def own():
        support.empty_scene()
        start = time.perf_counter()
        bpy.ops.motus.grid_add(width=SIDE, height=SIDE, spacing=SPACING)
        return time.perf_counter() - start

    def blender():
        support.empty_scene()
        start = time.perf_counter()
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=SIDE - 1, y_subdivisions=SIDE - 1, size=SIDE * SPACING)
        return time.perf_counter() - start

    table = Table(f"A grid of {SIDE} x {SIDE} vertices", Column("taken", "ms", "9.1f"), Column("of Blender", "x"))
    rows = [("Blender's Grid", min(blender() for _ in range(3))), ("motus.grid_add", min(own() for _ in range(3)))]
    for name, value in rows:
        table.row(name, value * 1e3, value / rows[0][1])


if __name__ == "__main__":
    support.enable()
    report_grid()
    report_start()
    report_dabs()
