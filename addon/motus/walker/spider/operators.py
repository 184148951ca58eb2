"""Operator that adds a spider: armature, mesh, and walker."""

import bpy
from mathutils import Vector

from ...core import wiring
from ...core.interface.operators import OBJECT_MODE, FindsValues, select_only
from ...core.interface.rows import Rows
from ...core.interface.view import viewports
from ...core.refusals import check_finite
from ...core.translations import tr
from .. import rows, setup, targets
from ..operators import GroundKeywords, ground_of
from ..properties import KEYWORDS, MOST_LEGS, WalkerKeywords
from . import mesh, rig


class MOTUS_OT_spider_add(FindsValues, WalkerKeywords, GroundKeywords, bpy.types.Operator):
    bl_idname = "motus.spider_add"
    bl_label = "Add Spider"
    bl_description = "Make a spider that walks wherever its armature is moved: key it, or let it follow a path"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    legs: bpy.props.IntProperty(name="Legs", description="Number of the spider's legs", default=8, min=2, max=MOST_LEGS, soft_max=16)
    size: bpy.props.FloatProperty(
        name="Span",
        description="Distance between the feet of one side and the other",
        default=1.0,
        min=1e-3,
        max=1000.0,
        soft_min=0.1,
        soft_max=10.0,
        subtype='DISTANCE',
    )
    color: bpy.props.FloatVectorProperty(
        name="Color",
        description="Color of the bands on the legs, and of the pattern on the back",
        size=4,
        subtype='COLOR',
        min=0.0,
        max=1.0,
        default=(0.72, 0.17, 0.02, 1.0),
    )
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Location of the spider; that of the 3D cursor if it is not given",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )

    modes = OBJECT_MODE
    needs_native = True
    redo = (Rows(("legs", "size", "color"), title="Spider"), *rows.ALL)

    def invoke(self, context, _event):
        if not self.is_given("location"):
            self.location = viewports.seen_place(context, context.scene.cursor.location)
        return self.execute(context)

    def run(self, context):
        check_finite(self, (*KEYWORDS, "size", "color", "location"))
        ground = ground_of(self)
        place = Vector(self.location) if self.is_given("location") else context.scene.cursor.location.copy()
        spider = rig.build(context, tr("Spider"), place, self.legs, self.size)
        mesh.build(spider, self.legs, self.size, tuple(self.color))
        rig.reach(spider, self.legs)
        setup.attach(context, spider, targets.legs_for(context, spider, ""), rig.BODY, self.given(KEYWORDS) | ground)
        self.show_used(spider.motus.walker, KEYWORDS)
        select_only(context, spider)
        wiring.report_problems(self, context, setup.system(), [spider])


classes = (MOTUS_OT_spider_add,)
