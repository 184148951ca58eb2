"""Solver of pins: computes how far all pins together move each vertex of the mesh."""

from ...core import native
from ...core.declare import Group, Problem, Vertices
from ...core.lazy import numpy as np
from ..properties import is_finite
from . import binding, shapes, table

NOT_A_MESH = Problem("Pins move the points of a mesh, and this is none")
NOT_FINITE_MESH = Problem("The mesh has a vertex whose position is not a finite number")
BROKEN = Problem("Some pins have lost their place in the mesh and do nothing: bind them again", blocking=False)
UNUSABLE = Problem("Some pins have a setting that is not a usable number, and do nothing", blocking=False)
NO_GROUP = Problem("The vertex group of some pins is gone, so that they do nothing", blocking=False)
NO_SHAPE = Problem("The shape of some pins is gone from the mesh, so that they do nothing", blocking=False)
PROBLEMS = (NOT_A_MESH, NOT_FINITE_MESH, BROKEN, UNUSABLE, NO_GROUP, NO_SHAPE)

INPUTS = (Vertices("mesh"),)

UNBAKEABLE = Problem("Pins have nothing to bake, for their strengths are keyed: apply them to shape keys instead").sentence
"""Message of the operator motus.bake for an object with pins."""

OK, LOST, AMBIGUOUS = binding.OK, binding.LOST, binding.AMBIGUOUS
NOT_USABLE, WITHOUT_GROUP, WITHOUT_SHAPE = 3, 4, 5
"""Further status numbers of pins, which the solver outputs beside OK, LOST and AMBIGUOUS."""
PROBLEM_OF = {LOST: BROKEN, AMBIGUOUS: BROKEN, NOT_USABLE: UNUSABLE, WITHOUT_GROUP: NO_GROUP, WITHOUT_SHAPE: NO_SHAPE}


def groups(owner):
    """Declare the solver's outputs to the registry: one group with the status of each pin, in the order of the list."""
    return (Group(outputs=tuple(f"pin{index}" for index in range(len(owner.motus.pull.pins)))),)


def solve(context, mesh):
    """Write the displacement of each vertex by the pins into context.offsets (in the object's space), and the status of each pin.

    mesh: evaluated mesh of the owner. Returns a Problem or None; a user's error never raises an exception.
    """
    if mesh is None:
        return NOT_A_MESH
    done = displace(context.owner, mesh, table.read(context.settings.pins), context.offsets)
    if done is None:
        return NOT_FINITE_MESH
    states, context.wants_to_settle = done
    known = min(len(states), len(context.outputs))  # pins that a script has just added have no output yet
    context.outputs[:known] = states[:known]
    problems = [PROBLEM_OF[state] for state in states if state != OK]
    return min(problems, key=PROBLEMS.index) if problems else None


def displace(owner, mesh, rows, offsets):
    """Add the displacements by the pins, one pin after another, to the offsets (n, 3) of a mesh's vertices.

    rows: table.Row of each pin. Returns (status of each pin, whether a pulled vertex differs in index or position from what its pin has
    stored); None if a position of the mesh is not finite.
    """
    shape = shapes.shape_of(mesh, rows)
    if not shape.is_finite:
        return None
    states, is_unsettled = [], False
    for row in rows:
        if row.shape:
            states.append(_apply_shape(mesh, row, offsets))
            continue
        root, state, reached = shape.find(row) if row.is_usable else (None, NOT_USABLE, None)
        if root is not None:
            is_unsettled |= root != row.vertex or tuple(shape.positions[root].tolist()) != row.place
            state = _apply(owner, mesh, shape, row, reached, offsets)
        states.append(state)
    shape.forget_but(len(rows))
    return states, is_unsettled


def _apply(owner, mesh, shape, row, reached, offsets):
    weights = None
    if row.vertex_group:
        group = owner.vertex_groups.get(row.vertex_group)
        if group is None:
            return WITHOUT_GROUP
        weights = reached.together(_weights(mesh, group.index, reached.compact[0]))
    if not row.is_muted and row.strength != 0.0:
        move(offsets, shape.positions, row, reached, weights)
    return OK


def _apply_shape(mesh, row, offsets):
    found = binding.shape(mesh, row.shape)
    if found is None:
        return OK if mesh.is_editmode else WITHOUT_SHAPE  # in Edit Mode attributes cannot be read, and pins have no effect
    furthest = max(found.max(initial=0.0), -found.min(initial=0.0))
    if not (row.is_usable and is_finite(furthest) and is_finite(row.strength * float(furthest))):
        return NOT_USABLE
    if not row.is_muted and row.strength != 0.0:
        found *= np.float32(row.strength)
        offsets += found
    return OK


def move(offsets, positions, row, reached, weights):
    """Apply one pin to the positions + offsets of a mesh, and change the offsets in place.

    row: table.Row of the pin. reached: its Reached. weights: of the reached vertices, or None for 1.
    """
    keywords = {"mirror": row.mirror, **row.profile}
    if row.limits is None and weights is None:
        native.module.pull(offsets, (0.0, 0.0, 0.0), row.way, row.radius, reach=reached.reaches, out=offsets, **keywords)
        return
    indices, reaches = reached.compact
    if row.limits is not None:
        keywords |= dict(zip(("clamp_axis", "minimum", "maximum"), row.limits))
    before = positions[indices] + offsets[indices]
    after = native.module.pull(before, (0.0, 0.0, 0.0), row.way, row.radius, weights=weights, reach=reaches, **keywords)
    offsets[indices] += after - before


def _weights(mesh, group, indices):
    """Weights of these vertices of an evaluated mesh in the vertex group of index `group`, float32; 0 outside the group."""
    vertices = mesh.vertices
    found = (next((entry.weight for entry in vertices[index].groups if entry.group == group), 0.0) for index in indices.tolist())
    return np.fromiter(found, np.float32, len(indices))
