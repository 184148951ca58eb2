"""Helpers for armatures of the demo scenes: bones in rows along lines, and skins whose vertices are carried by several bones."""

import bpy
import numpy as np

from . import shapes


def along(points, count, fine=400):
    """Return `count` places at equal distances on a smooth curve through points, as an array (count, 3)."""
    points = np.asarray(points, dtype=float)
    curve = shapes.smooth_profile(np.column_stack((np.arange(len(points)), points)), fine)[:, 1:]
    way = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))))
    wanted = np.linspace(0.0, way[-1], count)
    return np.stack([np.interp(wanted, way, curve[:, axis]) for axis in range(3)], axis=1)


def names(stem, count):
    """List the names of the bones of a row, the topmost first. A side such as ".L" at the stem's end stays at the end."""
    stem, dot, side = stem.partition(".")
    return [f"{stem} {index + 1}{dot}{side}" for index in range(count)]


class Armature:
    """An armature object in Edit Mode: its bones are added in a `with` statement. object: the object."""

    def __init__(self, context, collection, name):
        self._context = context
        self.object = shapes.link_object(collection, name, bpy.data.armatures.new(name))
        self.object.data.display_type = "STICK"

    def __enter__(self):
        for other in self._context.selected_objects:
            other.select_set(False)
        self._context.view_layer.objects.active = self.object
        self.object.select_set(True)
        bpy.ops.object.mode_set(mode="EDIT")
        return self

    def __exit__(self, *_error):
        bpy.ops.object.mode_set(mode="OBJECT")

    def add(self, name, parent, head, tail, deforms=True):
        """Add a bone. parent: name of a bone; "" for none. deforms: whether the bone carries a skin."""
        bones = self.object.data.edit_bones
        bone = bones.new(name)
        bone.head, bone.tail, bone.use_deform = head, tail, deforms
        bone.parent = bones[parent] if parent else None
        bone.use_connect = bool(parent) and (bone.parent.tail - bone.head).length < 1e-6

    def add_row(self, stem, parent, places):
        """Add a row of bones between places, (count + 1, 3). Returns their names."""
        row = names(stem, len(places) - 1)
        for name, head, tail in zip(row, places, places[1:]):
            self.add(name, parent, head, tail)
            parent = name
        return row


class Skin:
    """Collects parts of a mesh with the shares that bones have of their vertices."""

    def __init__(self):
        self._builder, self._groups = shapes.MeshBuilder(), []

    def add(self, part, slot, shares, smooth=True):
        """Add a part, (vertices, faces). slot: index of its material. shares: {bone name: one share, or one for each vertex}."""
        count = len(part[0])
        self._builder.add(part, slot, smooth)
        self._groups.append((count, {bone: np.broadcast_to(share, count) for bone, share in shares.items()}))

    def finish(self, collection, name, materials):
        """Make the mesh object; carry() lets bones move it. Returns the object."""
        thing = shapes.link_object(collection, name, self._builder.build(name, materials))
        first = 0
        for count, shares in self._groups:
            for bone, values in shares.items():
                group = thing.vertex_groups.get(bone) or thing.vertex_groups.new(name=bone)
                # Blender takes one weight for many vertices: shares are rounded, so that there are few different ones.
                rounded = np.round(values, 3)
                for value in np.unique(rounded[rounded > 0.0]):
                    group.add((first + np.flatnonzero(rounded == value)).tolist(), float(value), "REPLACE")
            first += count
        return thing


def carry(thing, *rigs):
    """Let the bones of rigs move the vertices of a mesh object."""
    thing.parent = rigs[0]
    for rig in rigs:
        thing.modifiers.new(rig.name, "ARMATURE").object = rig


def shares_along(row, at):
    """Return {bone name: shares} of vertices for the bones of a row: each bone fades into its neighbours.

    at: places of the vertices along the row, (n,), in bones from its start.
    """
    middles = np.arange(len(row)) + 0.5
    near = np.clip(1.0 - np.abs(at[None, :] - middles[:, None]), 0.0, 1.0)
    near[0, at < middles[0]] = 1.0
    near[-1, at > middles[-1]] = 1.0
    return dict(zip(row, near))


def tube(places, radius, sides=10, flat=1.0, across=(0.0, 1.0, 0.0), rings=4):
    """Return (part, places of its vertices in bones from the start) of a closed tube along places, (count + 1, 3), of a row of bones.

    radius: one, or one for each ring; there are `rings` of them a bone, and one more. flat: thickness along `across`, as a share of the
    width. across: direction that is not parallel to the row anywhere.
    """
    places = np.asarray(places, dtype=float)
    at = np.linspace(0.0, len(places) - 1.0, rings * (len(places) - 1) + 1)
    line = np.stack([np.interp(at, np.arange(len(places)), places[:, axis]) for axis in range(3)], axis=1)
    ahead = np.gradient(line, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    wide = np.cross(ahead, across)
    wide /= np.linalg.norm(wide, axis=1, keepdims=True)
    thick = np.cross(wide, ahead)
    radius = np.broadcast_to(np.asarray(radius, dtype=float), len(line)).copy()
    angle = shapes.ring(sides)
    reach = np.cos(angle)[None, :, None] * wide[:, None] + flat * np.sin(angle)[None, :, None] * thick[:, None]
    sections = line[:, None] + radius[:, None, None] * reach
    # A ring without width closes each end.
    sections = np.concatenate((np.repeat(line[:1, None], sides, axis=1), sections, np.repeat(line[-1:, None], sides, axis=1)))
    at = np.concatenate((at[:1], at, at[-1:]))
    return shapes.loft(sections[:, ::-1]), np.repeat(at, sides)
