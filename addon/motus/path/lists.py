"""Operators of the lists in the Follow Path panel: pins and wagons."""

import bpy

from ..core import wiring
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.interface.operators import OBJECT_MODE, Operator, object_keyword, select_only
from ..core.interface.rows import Row, Rows
from ..core.measures import scene_time
from ..core.refusals import Refused, check_finite, named
from ..core.settings import lists
from ..core.translations import tr
from . import members, motion, setup, targets
from .gaps import touching_gaps
from .operators import follower_for
from .properties import DEFAULT_DELAY, SLOWEST


def _pins_by(unit):
    """Make the condition under which a row of the operator's panel is shown: the active follower's pins are given by `unit`.

    A pin sets the place on the path at one frame. unit: 'FRACTION' of the path's length, or 'DISTANCE' along the path.
    """
    return lambda _operator: bpy.context.object is None or bpy.context.object.motus.path.pins_by == unit


class MOTUS_OT_path_pin_add(Operator, bpy.types.Operator):
    bl_idname = "motus.path_pin_add"
    bl_label = "Add Pin"
    bl_description = "Add a pin, which puts the object at a place of the path at a frame; by default at its present place and frame"

    object: object_keyword("Name of the object; empty takes the active one")
    frame: bpy.props.FloatProperty(name="Frame", description="Frame at which the object is at the pin's place", options={'SKIP_SAVE'})
    fraction: bpy.props.FloatProperty(
        name="Fraction",
        description="Where the object is at the pin's frame: 0 at the start of the path, 1 at its end",
        options={'SKIP_SAVE'},
    )
    distance: bpy.props.FloatProperty(
        name="Distance", description="Distance from the start of the path", subtype='DISTANCE', options={'SKIP_SAVE'}
    )
    redo = (Rows(("frame", Row("fraction", when=_pins_by('FRACTION')), Row("distance", when=_pins_by('DISTANCE')))),)

    def run(self, context):
        obj = follower_for(context, self.object)
        settings = obj.motus.path
        check_finite(self, ("frame", "fraction", "distance"))
        here = _here_and_now(context, obj)
        for name in ("frame", "fraction", "distance"):
            if not self.is_given(name):
                setattr(self, name, here[name])
        replaced = any(pin.frame == self.frame for pin in settings.pins)
        settings.active_pin = _only_one(settings.pins, "frame", self.frame, "Pin")
        pin = settings.pins[settings.active_pin]
        pin.fraction, pin.distance = self.fraction, self.distance
        settings.timing = 'PINS'
        wiring.touch(setup.system(), obj)
        if replaced:
            self.report({'INFO'}, tr("Replaced the pin at frame {frame}").format(frame=f"{self.frame:g}"))


class EntryRemover(Operator):
    """Mixin of the operators that remove an entry of a follower's list, with the keywords `object` and `index`.

    Subclasses declare entries, active: names of the settings with the list and with the index of its active entry.
    """

    entries = active = ""

    def absent(self):
        """Sentence for an index that the list does not have."""
        raise NotImplementedError

    def run(self, context):
        obj = follower_for(context, self.object)
        settings = obj.motus.path
        entries, active = getattr(settings, self.entries), getattr(settings, self.active)
        index = active if self.index < 0 else self.index
        if not 0 <= index < len(entries):
            raise Refused(self.absent())
        lists.remove(entries, index)
        setattr(settings, self.active, max(0, min(active, len(entries) - 1)))
        wiring.touch(setup.system(), obj)


class MOTUS_OT_path_pin_remove(EntryRemover, bpy.types.Operator):
    bl_idname = "motus.path_pin_remove"
    bl_label = "Remove Pin"
    bl_description = "Remove a pin of the path"

    object: object_keyword("Name of the object; empty takes the active one")
    index: bpy.props.IntProperty(
        name="Index", description="Index of the pin; -1 is the active one", default=-1, min=-1, options={'SKIP_SAVE'}
    )
    entries, active = "pins", "active_pin"

    def absent(self):
        return tr("There is no such pin")


class MOTUS_OT_path_speed_add(Operator, bpy.types.Operator):
    bl_idname = "motus.path_speed_add"
    bl_label = "Add Speed"
    bl_description = "Add the speed at a place of the path; by default the present speed at the present place"

    object: object_keyword("Name of the object; empty takes the active one")
    distance: bpy.props.FloatProperty(
        name="Distance", description="Distance from the start of the path", subtype='DISTANCE', options={'SKIP_SAVE'}
    )
    speed: bpy.props.FloatProperty(
        name="Speed",
        description="Speed of the object at this place; on the way to the next place it changes evenly",
        min=SLOWEST,
        unit='VELOCITY',
        options={'SKIP_SAVE'},
    )
    redo = (Rows(("distance", "speed")),)

    def run(self, context):
        obj = follower_for(context, self.object)
        settings, here = obj.motus.path, _here_and_now(context, obj)
        here["distance"] = motion.place_on_path(settings, here["distance"], here["length"])
        check_finite(self, ("distance", "speed"))
        for name in ("distance", "speed"):
            if not self.is_given(name):
                setattr(self, name, here[name] if here[name] or name == "distance" else settings.speed)
        settings.active_speed = _only_one(settings.speeds, "distance", self.distance, "Speed")
        settings.speeds[settings.active_speed].speed = self.speed
        settings.timing = 'PLACES'
        wiring.touch(setup.system(), obj)


class MOTUS_OT_path_speed_remove(EntryRemover, bpy.types.Operator):
    bl_idname = "motus.path_speed_remove"
    bl_label = "Remove Speed"
    bl_description = "Remove the speed at a place of the path"

    object: object_keyword("Name of the object; empty takes the active one")
    index: bpy.props.IntProperty(
        name="Index", description="Index of the speed; -1 is the active one", default=-1, min=-1, options={'SKIP_SAVE'}
    )
    entries, active = "speeds", "active_speed"

    def absent(self):
        return tr("There is no such speed")


class MOTUS_OT_path_wagon_add(Operator, bpy.types.Operator):
    bl_idname = "motus.path_wagon_add"
    bl_label = "Add Wagons"
    bl_description = "Couple the other selected objects to the end of the train"

    object: object_keyword("Name of the leader; empty takes the active one")
    wagon: bpy.props.StringProperty(
        name="Wagon", description="Name of the wagon; empty takes the other selected objects", options={'SKIP_SAVE'}
    )
    gap: bpy.props.FloatProperty(
        name="Gap",
        description="Distance along the path to the object in front; 0 takes the lengths of the objects",
        default=0.0,
        min=0.0,
        subtype='DISTANCE',
    )
    redo = (Rows(("gap",)),)

    def run(self, context):
        obj = follower_for(context, self.object)
        settings = obj.motus.path
        check_finite(self, ("gap",))
        wagons = [named(self.wagon)] if self.wagon else [found for found in targets.selected_followers(context) if found != obj]
        for wagon in wagons:
            targets.check_wagon(wagon, pointed(settings, "curve"))
        if not wagons:
            raise Refused(tr("Select the objects to couple, and the leader last"))
        train = members.wagons(obj)
        in_front = train[-1].object if train else obj
        delay, wheelbase = (train[-1].delay, train[-1].wheelbase) if train else (DEFAULT_DELAY, settings.wheelbase)
        gaps = [self.gap] * len(wagons) if self.gap else touching_gaps([in_front, *wagons], chosen(settings, "forward_axis"))
        # Without Line Up the first wagons would stand in one place before the start.
        ends = {"extend": 'LINE_UP'} if settings.extend == 'CLAMP' and not train else {}
        added = [members.Wagon(wagon, gap, delay, wheelbase) for wagon, gap in zip(wagons, gaps)]
        setup.attach(obj, pointed(settings, "curve"), ends, train + added)
        settings.active_wagon = len(settings.wagons) - 1


class WagonOperator(Operator):
    """Mixin of the operators that act on one wagon (an object that follows a leader) of a train."""

    object: object_keyword("Name of the leader; empty takes the active one")
    index: bpy.props.IntProperty(
        name="Index", description="Index of the wagon; -1 is the active one", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    def chosen(self, context):
        """(leader of the train, index of the wagon) that the operator's keywords name. Raises Refused if there is no such wagon."""
        obj = follower_for(context, self.object)
        settings = obj.motus.path
        index = settings.active_wagon if self.index < 0 else self.index
        if not 0 <= index < len(settings.wagons):
            raise Refused(tr("There is no such wagon"))
        return obj, index


class MOTUS_OT_path_wagon_remove(WagonOperator, bpy.types.Operator):
    bl_idname = "motus.path_wagon_remove"
    bl_label = "Remove Wagon"
    bl_description = "Take a wagon out of the train; the wagons behind it keep their places"

    def run(self, context):
        obj, index = self.chosen(context)
        settings = obj.motus.path
        targets.check_uncouplable(obj, index)
        setup.uncouple(obj, index)
        settings.active_wagon = max(0, min(settings.active_wagon, len(settings.wagons) - 1))


class MOTUS_OT_path_wagon_move(WagonOperator, bpy.types.Operator):
    bl_idname = "motus.path_wagon_move"
    bl_label = "Move Wagon"
    bl_description = "Exchange a wagon with the wagon in front of it or behind it; the gaps stay where they are"

    direction: bpy.props.EnumProperty(
        name="Direction",
        description="Direction in which the item moves in the list",
        items=(('UP', "Up", ""), ('DOWN', "Down", "")),
        default='UP',
    )
    redo = (Rows(("direction",)),)

    def run(self, context):
        obj, index = self.chosen(context)
        settings = obj.motus.path
        place = index + (1 if self.direction == 'DOWN' else -1)
        if not 0 <= place < len(settings.wagons):
            raise Refused(tr("The wagon is at the end of the train already"))
        targets.check_uncouplable(obj, min(index, place))
        entries = settings.wagons
        # Gaps are of the places in the train, wheelbases are of the wagons.
        for name in ("gap", "delay"):
            first, second = getattr(entries[index], name), getattr(entries[place], name)
            setattr(entries[index], name, second)
            setattr(entries[place], name, first)
        lists.move(entries, index, place)
        setup.attach(obj, pointed(settings, "curve"), {}, members.wagons(obj))
        settings.active_wagon = place


class MOTUS_OT_path_wagons_touch(Operator, bpy.types.Operator):
    bl_idname = "motus.path_wagons_touch"
    bl_label = "Gaps from Sizes"
    bl_description = "Set each gap so that the wagon touches the object in front of it"

    object: object_keyword("Name of the leader; empty takes the active one")

    def run(self, context):
        obj = follower_for(context, self.object)
        wagons = [entry for entry in obj.motus.path.wagons if pointed(entry, "object")]
        if not wagons:
            raise Refused(tr("There is no such wagon"))
        gaps = touching_gaps([obj, *(pointed(entry, "object") for entry in wagons)], chosen(obj.motus.path, "forward_axis"))
        for entry, gap in zip(wagons, gaps):
            entry.gap = gap


class MOTUS_OT_path_select_leader(Operator, bpy.types.Operator):
    bl_idname = "motus.path_select_leader"
    bl_label = "Select Leader"
    bl_description = "Select the leader of the train, whose settings drive this wagon"

    def run(self, context):
        leader = context.object and pointed(context.object.motus.path, "leader")
        if leader is None:
            raise Refused(tr("Nothing here is a wagon of a train"))
        _select_alone(context, leader)


class MOTUS_OT_path_select_follower(Operator, bpy.types.Operator):
    bl_idname = "motus.path_select_follower"
    bl_label = "Select Follower"
    bl_description = "Select an object that follows this curve"

    object: object_keyword("Name of the follower; empty takes the first one of the active curve")
    modes = OBJECT_MODE

    def run(self, context):
        if self.object:
            follower = follower_for(context, self.object)
        else:
            followers = targets.followers_of(context.object) if context.object else []
            if not followers:
                raise Refused(tr("Nothing follows this curve"))
            follower = followers[0]
        _select_alone(context, follower)


def _select_alone(context, obj):
    if obj.name not in context.view_layer.objects:
        raise Refused(tr("{object} is not in this view layer").format(object=obj.name))
    select_only(context, obj)


def _only_one(entries, setting, value, word):
    """Index of the one entry of a list whose setting, a number, has this value: a new entry, which others with the value give way to.

    An entry with the value that an override has from its library stays, and is the one. word: by which a new entry is called.
    """
    found = [index for index, entry in enumerate(entries) if getattr(entry, setting) == value]
    count = lists.count_from_library(entries)
    for index in reversed([index for index in found if index >= count]):
        lists.remove(entries, index)
    if found and found[0] < count:
        return found[0]
    setattr(lists.add_numbered(entries, word), setting, value)
    return len(entries) - 1


def _here_and_now(context, obj):
    depsgraph = context.view_layer.depsgraph
    distance, length = (wiring.output(setup.system(), obj, name, depsgraph) or 0.0 for name in ("distance", "length"))
    speed = abs(wiring.output(setup.system(), obj, "speed", depsgraph) or 0.0)
    return {
        "distance": distance,
        "length": length,
        "speed": speed,
        "fraction": distance / length if length else 0.0,
        "frame": scene_time.present(context.scene),
    }


classes = (
    MOTUS_OT_path_pin_add,
    MOTUS_OT_path_pin_remove,
    MOTUS_OT_path_speed_add,
    MOTUS_OT_path_speed_remove,
    MOTUS_OT_path_wagon_add,
    MOTUS_OT_path_wagon_remove,
    MOTUS_OT_path_wagon_move,
    MOTUS_OT_path_wagons_touch,
    MOTUS_OT_path_select_leader,
    MOTUS_OT_path_select_follower,
)
