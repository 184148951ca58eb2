"""Operators that add and remove pendulums and their trails, play and pause pendulums, and select their pivots."""

import math

import bpy
from mathutils import Matrix

from ..core import wiring
from ..core.blender import actions
from ..core.file import libraries
from ..core.interface import placing
from ..core.interface.operators import OBJECT_MODE, FindsValues, OfAnObject, Operator, object_keyword, select_only
from ..core.interface.rows import Row, Rows, is_not, is_one_of
from ..core.measures import scene_time, units
from ..core.refusals import Refused, check_finite, check_local, named
from ..core.translations import tr
from . import build, parts, rows, targets, trail
from .properties import KEYWORDS, TRAIL_KEYWORDS, PendulumKeywords, TrailKeywords

ADDED = (
    ('SINGLE', "Single", "One rod with a bob"),
    ('DOUBLE', "Double", "A second rod hangs on the first one's bob"),
    ('SPHERICAL', "Spherical", "One rod with a bob that swings to all sides"),
    ('FAN', "Fan", "Double pendulums whose lower angles differ a little from one to the next"),
    ('CHAOS', "Demonstration", "A fan, beside it one pendulum alone, and a third one with quite other angles"),
)
TAKES = (
    ('NEW', "New Pivot", "An empty at the 3D cursor"),
    ('ACTIVE', "Active Object", "The pendulum hangs on the active object, which may be animated"),
    (
        'PLACED',
        "Selected Objects",
        "The active object is the pivot and the other selected ones, one or two, are the bobs: lengths and angles are theirs",
    ),
)
PLAYS = (
    ('TOGGLE', "Toggle", "Pause what plays, and play what is paused"),
    ('PLAY', "Play", "Let the time run from here on"),
    ('PAUSE', "Pause", "Let the time stand still from here on"),
)
OTHER_ANGLES = math.radians(-70.0), math.radians(-170.0)
APART = 1.25
"""Distance between neighbouring pivots of the demonstration, as a share of twice the length of both rods together."""

_has_look = is_one_of("take", 'NEW', 'ACTIVE')


class MOTUS_OT_pendulum_add(FindsValues, PendulumKeywords, placing.Placed, bpy.types.Operator):
    bl_idname = "motus.pendulum_add"
    bl_label = "Add Pendulum"
    bl_description = "Hang a pendulum, a double pendulum or a fan of them on a pivot"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    kind: bpy.props.EnumProperty(name="Kind", description="What is added", items=ADDED, default='DOUBLE')
    take: bpy.props.EnumProperty(name="Pivot", description="What the pendulum hangs on", items=TAKES, default='NEW', options={'SKIP_SAVE'})
    count: bpy.props.IntProperty(name="Count", description="How many pendulums the fan has", default=20, soft_min=1, soft_max=100)
    rod_radius: bpy.props.FloatProperty(
        name="Rod Radius", description="Radius of the rods", default=build.Look().rod_radius, min=1e-4, soft_max=0.2, subtype='DISTANCE'
    )
    bob_radius: bpy.props.FloatProperty(
        name="Bob Radius",
        description="Radius of a bob of 1 kg; heavier bobs are larger",
        default=build.Look().bob_radius,
        min=1e-4,
        soft_max=1.0,
        subtype='DISTANCE',
    )
    spacing: bpy.props.FloatProperty(
        name="Spacing",
        description="Distance from one pendulum of the fan to the next, across the plane of the swing",
        default=build.Look().spacing,
        subtype='DISTANCE',
    )
    hue: bpy.props.FloatProperty(
        name="Hue",
        description="Hue of the first pendulum; the hues of a fan go once around",
        default=build.Look().hue,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
    )
    use_trails: bpy.props.BoolProperty(
        name="Trails", description="Show the ways that the end bobs have come; the demonstration always does", default=False
    )
    object: object_keyword("Name of the object that is the pivot; empty goes by what is chosen as the pivot")
    bobs: bpy.props.StringProperty(
        name="Bobs",
        description="Names, with commas between, of one or two objects that are the bobs, from the pivot on",
        options={'SKIP_SAVE'},
    )

    modes = OBJECT_MODE
    needs_native = True
    redo = (
        Rows(("kind", "take", Row("count", when=is_one_of("kind", 'FAN', 'CHAOS'))), title="Add"),
        # Settings that the system's panel does not show come first, because the redo panel is higher than most viewports.
        Rows(
            (
                Row("rod_radius"),
                Row("bob_radius", when=_has_look),
                Row("spacing", when=is_one_of("kind", 'FAN', 'CHAOS')),
                "hue",
                Row("use_trails", when=is_not("kind", 'CHAOS')),
            ),
            title="Look",
        ),
        *rows.ALL,
        placing.rows(when=is_one_of("take", 'NEW')),
    )

    def run(self, context):
        pivots = self._add(context)
        for pivot in pivots if self.use_trails or self.kind == 'CHAOS' else ():
            trail.add(libraries.collection_for(context, pivot), pivot, {})
        select_only(context, *pivots)
        self.show_used(pivots[0].motus.pendulum, KEYWORDS)
        self.object = pivots[0].name if self.object else ""
        wiring.report_problems(self, context, build.system(), pivots)

    def _add(self, context):
        keywords = self._checked(context)
        bobs = []
        if self.bobs or self.take == 'PLACED':
            pivot, bobs = targets.placed_objects(context, self.object, self.bobs)
        elif self.object or self.take == 'ACTIVE':
            pivot = named(self.object) if self.object else context.object
            if pivot is None:
                raise Refused(tr("Select the object that shall be the pivot"))
        else:
            return self._add_new(context, keywords)
        if self.kind == 'CHAOS':
            raise Refused(tr("The demonstration has pivots of its own"))
        targets.check_free(pivot)
        kind = self.kind
        if bobs:
            targets.check_bobs(bobs)
            context.view_layer.update()
            kind = self._kind_of(bobs)
            keywords |= targets.measured(pivot, bobs, kind == 'SPHERICAL')
        count = self.count if kind == 'FAN' else 1
        build.attach(context, pivot, _rods_of(kind), count, keywords, self._look(context), bobs)
        return [pivot]

    def _kind_of(self, bobs):
        """Return 'DOUBLE' for two bobs, else 'SINGLE' or 'SPHERICAL'; refuses a different kind that was given together with the bobs."""
        kind = 'DOUBLE' if len(bobs) == 2 else 'SPHERICAL' if self.kind == 'SPHERICAL' else 'SINGLE'
        # If the bobs are the selected objects, a given kind is ignored, because an earlier call may have left it.
        if self.bobs and self.is_given("kind") and self.kind != kind:
            raise Refused(tr("A single pendulum has one placed bob, a double one two, and a fan none"))
        return kind

    def _add_new(self, context, keywords):
        place = self.place(context)
        if self.kind != 'CHAOS':
            count = self.count if self.kind == 'FAN' else 1
            return [self._hang(context, tr("Pendulum"), place, self.kind, count, keywords)]
        lengths = (keywords.get(name, getattr(self, name)) for name in ("length1", "length2"))
        along = Matrix.Translation((APART * 2.0 * sum(lengths), 0.0, 0.0))
        other = dict(zip(("angle1", "angle2"), OTHER_ANGLES))
        return [
            self._hang(context, tr("Fan"), place, 'DOUBLE', self.count, keywords),
            self._hang(context, tr("Alone"), place @ along, 'DOUBLE', 1, keywords),
            self._hang(context, tr("Other Angles"), place @ along @ along, 'DOUBLE', 1, keywords | other, 0.6),
        ]

    def _hang(self, context, name, place, kind, count, keywords, hue=0.0):
        pivot = build.new_pivot(context, name, place)
        look = self._look(context)
        look = look._replace(hue=(look.hue + hue) % 1.0)
        build.attach(context, pivot, _rods_of(kind), count, keywords, look, has_made_pivot=True)
        return pivot

    def _look(self, context):
        free = [name for name in ("rod_radius", "bob_radius", "spacing") if not self.is_given(name)]
        look = build.Look(self.rod_radius, self.bob_radius, self.spacing, self.hue)
        return look._replace(**units.defaults(context.scene, self.properties, free))

    def _checked(self, context):
        """Return the operator's keywords, completed by defaults from the scene; refuses values with which no pendulum can be made."""
        keywords = self.given(KEYWORDS)
        check_finite(self, (*KEYWORDS, "rod_radius", "bob_radius", "spacing", "hue"))
        positive = ("length1", "length2", "mass1", "mass2", "most_velocity", "most_acceleration")
        for name in positive:
            if not getattr(self, name) > 0.0:
                raise Refused(tr("{keyword} must be greater than 0").format(keyword=name))
        for name in ("gravity", "damping"):
            if getattr(self, name) < 0.0:
                raise Refused(tr("{keyword} must not be less than 0").format(keyword=name))
        if not 1 <= self.count <= parts.LARGEST_FAN:
            raise Refused(tr("A fan has 1 to {count} pendulums").format(count=parts.LARGEST_FAN))
        return self._with_those_of_scene(context.scene, keywords)

    def _with_those_of_scene(self, scene, keywords):
        found = units.defaults(scene, self.properties, [name for name in KEYWORDS if name not in keywords])
        if not (units.is_gravity_meant(scene) or "gravity" in keywords or "use_scene_gravity" in keywords):
            found["use_scene_gravity"] = False
        return {"start_frame": scene_time.beginning(scene)} | keywords | found


def _rods_of(kind):
    return kind if kind in {'SINGLE', 'SPHERICAL'} else 'DOUBLE'


class MOTUS_OT_pendulum_remove(Operator, bpy.types.Operator):
    bl_idname = "motus.pendulum_remove"
    bl_label = "Remove Pendulum"
    bl_description = "Take the pendulum off its pivot, with the rods and bobs that were made for it"

    object: object_keyword("Name of the pivot, or of a rod or bob; empty takes the selected ones")
    keep_objects: bpy.props.BoolProperty(
        name="Keep Objects", description="Keep the pivot, rods and bobs that were made, at rest", default=False
    )

    modes = OBJECT_MODE
    redo = (Rows(("keep_objects",)),)

    @classmethod
    def check_offer(cls, context):
        _check_any(targets.set_up(context))

    def run(self, context):
        if self.object:
            found = [targets.removable(named(self.object))]
        else:
            found = targets.set_up(context)
        found = [one for one in found if one]
        _check_any(found)
        for one in found:
            targets.check_editable(one)
        names = [one.name for one in found]
        for one in found:
            if parts.is_stray_trail(one):
                trail.discard(one)
            elif parts.is_stray(one):
                build.free(one, self.keep_objects)
            else:
                build.clear(one, self.keep_objects)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=", ".join(names)))


def _check_any(found):
    if not found:
        raise Refused(tr("Nothing here is part of a pendulum"))


class _OfAPivot(OfAnObject):
    """Base class of operators on the pendulum to which an object belongs."""

    object: object_keyword("Name of the pivot, or of a rod or bob; empty takes the active one")
    modes = OBJECT_MODE
    found = staticmethod(targets.pivot_for)


class MOTUS_OT_pendulum_play(_OfAPivot, bpy.types.Operator):
    bl_idname = "motus.pendulum_play"
    bl_label = "Play or Pause Pendulum"
    bl_description = "Key on the present frame whether the pendulum's time runs"

    play: bpy.props.EnumProperty(
        name="Play", description="Whether the time runs or stands still from the present frame on", items=PLAYS, default='TOGGLE'
    )

    redo = (Rows((Row("play", expand=True),)),)

    def run(self, context):
        pivot = self.found(context, self.object)
        check_local(pivot)
        settings, frame = pivot.motus.pendulum, scene_time.present(context.scene)
        is_playing = not settings.is_playing if self.play == 'TOGGLE' else self.play == 'PLAY'
        path = "motus.pendulum.is_playing"
        actions.make_local(pivot)
        if actions.find(pivot, path) is None and frame > settings.start_frame:
            pivot.keyframe_insert(path, frame=settings.start_frame, group="Pendulum")
        settings.is_playing = is_playing
        if actions.find(pivot, path) is not None:
            pivot.keyframe_insert(path, frame=frame, group="Pendulum")
        context.view_layer.update()


class MOTUS_OT_pendulum_trail_add(_OfAPivot, TrailKeywords, bpy.types.Operator):
    bl_idname = "motus.pendulum_trail_add"
    bl_label = "Add Trails"
    bl_description = "Show the ways that the end bobs of a pendulum have come, as tubes in the bobs' colours"

    needs_native = True
    redo = (rows.TRAIL,)

    def run(self, context):
        pivot = self.found(context, self.object)
        check_finite(self, TRAIL_KEYWORDS)
        if not self.seconds > 0.0:
            raise Refused(tr("{keyword} must be greater than 0").format(keyword="seconds"))
        trail.add(libraries.collection_for(context, pivot), pivot, self.given(TRAIL_KEYWORDS))


class MOTUS_OT_pendulum_trail_remove(_OfAPivot, bpy.types.Operator):
    bl_idname = "motus.pendulum_trail_remove"
    bl_label = "Remove Trails"
    bl_description = "Take the trails of a pendulum away"

    @classmethod
    def check_offer(cls, context):
        _check_trail(cls.found(context, ""))

    def run(self, context):
        pivot = self.found(context, self.object)
        _check_trail(pivot)
        trail.remove(pivot)


def _check_trail(pivot):
    if parts.own_trail(pivot) is None:
        raise Refused(tr("{object} has no trails").format(object=pivot.name))


class MOTUS_OT_pendulum_select_pivot(Operator, bpy.types.Operator):
    bl_idname = "motus.pendulum_select_pivot"
    bl_label = "Select Pivot"
    bl_description = "Select the object whose settings drive this one"

    modes = OBJECT_MODE

    def run(self, context):
        pivot = parts.pivot_of(context.object) if context.object else None
        if pivot is None:
            raise Refused(tr("Nothing here is part of a pendulum"))
        select_only(context, pivot)


classes = (
    MOTUS_OT_pendulum_add,
    MOTUS_OT_pendulum_remove,
    MOTUS_OT_pendulum_play,
    MOTUS_OT_pendulum_trail_add,
    MOTUS_OT_pendulum_trail_remove,
    MOTUS_OT_pendulum_select_pivot,
)
