"""Operator that adds a flat grid of vertices, from which landscapes can be pulled."""

import bpy
from bpy_extras.object_utils import object_data_add

from ..core.interface import placing
from ..core.interface.operators import OBJECT_OR_EDIT_MODE, Operator
from ..core.interface.rows import Row, Rows, is_one_of
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from .properties import is_finite

MOST_VERTICES = 100_000_000
SIZINGS = (
    ('SPACING', "Spacing", "The distance between neighbouring vertices is given"),
    ('SIZE', "Size", "The size of the whole grid is given"),
)


class MOTUS_OT_grid_add(Operator, placing.Placed, bpy.types.Operator):
    bl_idname = "motus.grid_add"
    bl_label = "Grid Mesh"
    bl_description = "Add a flat grid with a given number of vertices, centred on its origin"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    width: bpy.props.IntProperty(name="Width", description="Number of vertices along X", default=101, min=2, soft_max=2001)
    height: bpy.props.IntProperty(name="Height", description="Number of vertices along Y", default=101, min=2, soft_max=2001)
    sizing: bpy.props.EnumProperty(
        name="Sizing",
        description="What sets the size of the grid: its whole size, or the distance between vertices",
        items=SIZINGS,
        default='SPACING',
    )
    spacing: bpy.props.FloatProperty(
        name="Spacing", description="Distance between neighbouring vertices", default=0.1, min=1e-6, soft_max=10.0, subtype='DISTANCE'
    )
    size: bpy.props.FloatVectorProperty(
        name="Size",
        description="Lengths along X and Y",
        size=2,
        default=(10.0, 10.0),
        min=1e-6,
        soft_max=1000.0,
        subtype='XYZ',
        unit='LENGTH',
    )
    use_smooth: bpy.props.BoolProperty(name="Shade Smooth", description="Shade the faces as one smooth surface", default=True)
    use_uv: bpy.props.BoolProperty(name="UV Map", description="Lay the whole grid over the unit square of a UV map", default=True)

    redo = (
        Rows(("width", "height"), title="Vertices"),
        Rows(
            (
                Row("sizing", expand=True),
                Row("spacing", when=is_one_of("sizing", 'SPACING')),
                Row("size", when=is_one_of("sizing", 'SIZE')),
                "use_smooth",
                "use_uv",
            ),
            title="Size",
        ),
        placing.rows(),
    )

    modes = OBJECT_OR_EDIT_MODE

    def run(self, context):
        for name in ("spacing", "size"):
            if not is_finite(getattr(self, name)):
                raise Refused(tr("{keyword} is not a finite number").format(keyword=name))
        size = tuple(self.size)
        if self.sizing == 'SPACING':
            size = (self.width - 1) * self.spacing, (self.height - 1) * self.spacing
        if self.width * self.height > MOST_VERTICES:
            raise Refused(tr("More than {count} vertices do not fit into one mesh").format(count=MOST_VERTICES))
        self.place(context)  # sets the properties that object_data_add() reads
        mesh = grid_mesh(bpy.app.translations.pgettext_data("Grid"), self.width, self.height, size, self.use_smooth, self.use_uv)
        object_data_add(context, mesh, operator=self)


def grid_mesh(name, width, height, size, is_smooth=True, has_uv=True):
    """Create a mesh of width x height vertices in the plane z = 0, with normals along +Z.

    The vertices are in rows along +X; the first row has the least Y. size: lengths of the sides along X and Y.
    """
    mesh = bpy.data.meshes.new(name)
    steps = [np.linspace(0.0, 1.0, count) for count in (width, height)]
    fractions = np.empty((height, width, 2), np.float32)
    fractions[..., 0], fractions[..., 1] = steps[0][None, :], steps[1][:, None]
    places = np.zeros((height, width, 3), np.float32)
    for axis in (0, 1):
        row = ((steps[axis] - 0.5) * size[axis]).astype(np.float32)
        places[..., axis] = row[None, :] if axis == 0 else row[:, None]
    corners = _corners(width, height)
    mesh.vertices.add(width * height)
    _set(mesh, "position", "vector", mesh.vertices, "co", places)
    _add_faces(mesh, corners, width, height)
    if has_uv:
        layer = mesh.uv_layers.new(do_init=False)
        uv = fractions.reshape(-1, 2)[corners.ravel()]
        if hasattr(layer, "uv"):
            layer.uv.foreach_set("vector", uv.ravel())
        else:
            layer.data.foreach_set("uv", uv.ravel())
    if is_smooth != _is_smooth_at_first(mesh):
        mesh.polygons.foreach_set("use_smooth", np.full(len(mesh.polygons), is_smooth))
    mesh.update()
    return mesh


def _corners(width, height):
    """Vertex indices of each face, int32 (faces, 4), counterclockwise from the corner with the least X and Y."""
    vertices = np.arange(width * height, dtype=np.int32).reshape(height, width)
    rings = vertices[:-1, :-1], vertices[:-1, 1:], vertices[1:, 1:], vertices[1:, :-1]
    return np.stack(rings, axis=-1).reshape(-1, 4)


def _add_faces(mesh, corners, width, height):
    """Add faces and edges to a grid's mesh; mesh.update() of Blender would take far longer to find the edges."""
    vertices = np.arange(width * height, dtype=np.int32).reshape(height, width)
    along = np.stack((vertices[:, :-1], vertices[:, 1:]), axis=-1).reshape(-1, 2)
    across = np.stack((vertices[:-1], vertices[1:]), axis=-1).reshape(-1, 2)
    along_index = np.arange(len(along), dtype=np.int32).reshape(height, width - 1)
    across_index = np.arange(len(across), dtype=np.int32).reshape(height - 1, width) + len(along)
    sides = np.stack((along_index[:-1], across_index[:, 1:], along_index[1:], across_index[:, :-1]), axis=-1).reshape(-1)
    mesh.edges.add(len(along) + len(across))
    _set(mesh, ".edge_verts", "value", mesh.edges, "vertices", np.concatenate((along, across)))
    mesh.loops.add(corners.size)
    mesh.polygons.add(len(corners))
    mesh.polygons.foreach_set("loop_start", np.arange(0, corners.size, 4, dtype=np.int32))
    if not mesh.polygons[0].bl_rna.properties["loop_total"].is_readonly:
        mesh.polygons.foreach_set("loop_total", np.full(len(corners), 4, np.int32))
    _set(mesh, ".corner_vert", "value", mesh.loops, "vertex_index", corners)
    _set(mesh, ".corner_edge", "value", mesh.loops, "edge_index", sides)


def _set(mesh, attribute, value, items, prop, array):
    """Fill an attribute of the mesh if this Blender has the attribute, which is faster; otherwise set the property `prop` of the items."""
    found = mesh.attributes.get(attribute)
    if found is not None:
        found.data.foreach_set(value, array.ravel())
    else:
        items.foreach_set(prop, array.ravel())


def _is_smooth_at_first(mesh):
    """Whether new faces of a mesh are shaded smooth, as they are from Blender 4.1 on."""
    return mesh.polygons[0].use_smooth


classes = (MOTUS_OT_grid_add,)
