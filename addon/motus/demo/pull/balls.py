"""The balls of spare clay: a scan of loose triangles, pulled by a pin that welds them, and one that a lattice has bent into a shape key."""

import bpy
import numpy as np

from ..stage import keying

WELD = 0.002  # m within which vertices of the scan move as one
HORN = np.array((0.34, -0.30, 0.89))  # direction from the middle of the scanned ball in which it is pulled
PULLS = ((1, -0.05), (50, 0.17), (78, 0.12), (110, 0.20), (160, -0.06))  # frame of the cycle, and metres by which it is pulled
RADIUS = 0.22

LEAN = (0.10, -0.03, 0.15)  # m by which the top of the other ball is pulled
LEANS = ((1, 0.0), (36, 1.0), (60, 0.55), (84, 1.0), (140, 0.0))  # frame of the cycle, and value of the shape key


def build(context, scan, ball):
    """Pull both balls, with the public operators. scan, ball: their objects."""
    _loosen(scan.data)
    context.view_layer.update()
    _pin(scan)
    _lean(context, ball)


def _loosen(mesh):
    """Split a mesh into triangles that share no vertices, as some scans are."""
    mesh.calc_loop_triangles()
    corners = [tuple(triangle.vertices) for triangle in mesh.loop_triangles]
    places = np.array([mesh.vertices[index].co for triangle in corners for index in triangle])
    material = mesh.materials[0]
    mesh.clear_geometry()
    mesh.from_pydata(places.tolist(), [], np.arange(len(places)).reshape(-1, 3).tolist())
    mesh.update()
    if not mesh.materials:
        mesh.materials.append(material)


def _pin(scan):
    ways = np.array([vertex.co for vertex in scan.data.vertices])
    root = int(np.argmax((ways - ways.mean(axis=0)) @ HORN))
    _check(
        bpy.ops.motus.pin_add(
            object=scan.name,
            name="Horn",
            vertex=root,
            displacement=HORN,
            radius=RADIUS,
            falloff="SMOOTH",
            distance="SURFACE",
            weld=WELD,
            unit="LOCAL",
            mirror=set(),
            strength=0.0,
        ),
        scan,
    )
    keying.key_cycle(scan.motus.pull.pins["Horn"], "strength", PULLS)


def _lean(context, ball):
    """Bend a ball by a lattice, keep that as a shape key, and remove the lattice."""
    _check(bpy.ops.motus.lattice_fit(objects=ball.name, resolution=(3, 3, 3)), ball)
    context.view_layer.update()
    top = max(range(len(ball.data.vertices)), key=lambda index: ball.data.vertices[index].co.z)
    bottom = min(range(len(ball.data.vertices)), key=lambda index: ball.data.vertices[index].co.z)
    _check(bpy.ops.motus.lattice_pull(object=ball.name, vertex=top, displacement=LEAN, held=str(bottom)), ball)
    _check(bpy.ops.motus.lattice_keep(object=ball.name, name="Lean"), ball)
    _check(bpy.ops.motus.lattice_remove(objects=ball.name), ball)
    keying.key_cycle(ball.data.shape_keys.key_blocks["Lean"], "value", LEANS)


def _check(result, thing):
    if result != {"FINISHED"}:
        raise RuntimeError(f"{thing.name} could not be shaped")
