"""Operators that add chains to bones of a rig, objects in a row and points of curves, pin them, and remove them."""

import bpy

from ..core import wiring
from ..core.interface import bone_entries
from ..core.interface.operators import OBJECT_OR_POSE_MODE, FindsValues, OfARig, named_or_active, object_keyword
from ..core.refusals import (
    Refused,
    check_bone,
    check_evaluated,
    check_finite,
    check_no_tweak_mode,
    named,
)
from ..core.settings import drawn_curves, entries, lists, targets
from ..core.settings.declared import factor
from ..core.translations import counted, tr
from . import chosen, groups, mirroring, pins, properties, rows, setup, told

KEYWORDS = tuple(properties.ChainsKeywords.__annotations__)
TARGET_SIZE = 0.25
"""Display size of the empty of a new pin, in lengths of the bone."""


def rig_with(context, name):
    """Return the rig of this name, or the active object if the name is empty. Raises Refused if it has no chains."""
    rig = named_or_active(context, name)
    if rig.type != 'ARMATURE' or not rig.motus.chains.entries:
        raise Refused(tr("{object} has no chains").format(object=rig.name))
    return rig


def _warn(operator, context, rig):
    """Report what is wrong with the chains of a rig after an edit, if anything is."""
    context.view_layer.update()
    depsgraph = context.view_layer.depsgraph
    problem = wiring.problem(setup.system(), rig, depsgraph) if rig.evaluated_get(depsgraph).is_evaluated else None
    if problem:
        operator.report({'WARNING'}, told.sentence(rig, problem, context.scene))


def _bones():
    return bpy.props.StringProperty(
        name="Bones",
        description="Names of the topmost bones of the chains, with commas between; empty takes the selected bones",
        options={'SKIP_SAVE'},
    )


class MOTUS_OT_chains_add(FindsValues, properties.ChainsKeywords, bpy.types.Operator):
    bl_idname = "motus.chains_add"
    bl_label = "Add Chains"
    bl_description = "Let the selected bones and all bones below them hang and swing as chains, or points of a curve, or objects in a row on the active one"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}
    needs_native = True
    redo = rows.ADDING
    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Name of the object; empty takes the active one")
    bones: _bones()
    objects: bpy.props.StringProperty(
        name="Objects",
        description="Names of objects in a row, with commas between, in place of bones: the one that stays, then those that hang on it",
        options={'SKIP_SAVE'},
    )
    spline: bpy.props.IntProperty(
        name="Spline", description="Index of the spline of a curve whose points hang; -1 for all", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    @classmethod
    def check_offer(cls, context):
        chosen.wanted(context, "", "", "", -1).check_free()

    def run(self, context):
        found = chosen.wanted(context, self.object, self.bones, self.objects, self.spline)
        found.check_free()
        check_finite(self, KEYWORDS)
        drawn_curves.check(self.curve)
        owner, names = found.owner, found.names
        setup.add(owner, names, self.given(KEYWORDS), found.rows, found.splines)
        self.show_used(owner.motus.chains.entries[names[0]], KEYWORDS)
        self.report({'INFO'}, counted(len(names), tr("Chain added from {bone}").format(bone=names[0]), tr("{count} chains added")))
        _warn(self, context, owner)


class MOTUS_OT_chains_remove(OfARig, bpy.types.Operator):
    bl_idname = "motus.chains_remove"
    bl_label = "Remove Chains"
    bl_description = "Remove chains: in Pose Mode those of the selected bones, else all of the object, or that on which the object hangs"
    rig_with = staticmethod(chosen.owner_with)

    object: object_keyword("Name of the object; empty takes the active one")
    bones: _bones()
    only_active: bpy.props.BoolProperty(
        name="Only Active", description="Act on the active entry of the list alone", default=False, options={'SKIP_SAVE', 'HIDDEN'}
    )

    def run(self, context):
        owner = chosen.owner_with(context, self.object)
        chosen.check_editable(owner)
        check_no_tweak_mode(owner)
        is_freed = not self.only_active and groups.is_stray(owner)
        if is_freed:
            setup.free(owner)
        if owner.motus.chains.entries or not is_freed:
            self._remove(context, owner)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=owner.name))

    def _remove(self, context, owner):
        indices = self._indices(context, owner)
        lists.check_own(owner.motus.chains.entries, indices)
        setup.remove(owner, indices)

    def _indices(self, context, owner):
        settings = owner.motus.chains
        if self.only_active:
            return [settings.active_entry] if settings.active_entry >= 0 else []
        obj = named_or_active(context, self.object)
        names = [name.strip() for name in self.bones.split(",") if name.strip()]
        if not names and obj == owner:
            names = [] if self.object else bone_entries.posed(context)
            if not names:
                return range(len(settings.entries))
        places = [properties.index_of(settings, name) for name in names] if names else [properties.index_with(settings, obj)]
        found = sorted({*places} - {-1})
        if not found:
            raise Refused(tr("{object} has no chains").format(object=owner.name))
        return found


class MOTUS_OT_chains_pin(FindsValues, OfARig, bpy.types.Operator):
    bl_idname = "motus.chains_pin"
    bl_label = "Pin Chain"
    bl_description = "Hold the tails of the selected bones of chains, or else the end of the shown chain, to an object"
    needs_native = True
    redo = (rows.PINNING,)
    rig_with = staticmethod(rig_with)

    bones: bpy.props.StringProperty(
        name="Bones",
        description="Names of the bones whose tails are held, with commas between; empty takes the selected bones, and without any the "
        "last bone of the shown chain",
        options={'SKIP_SAVE'},
    )
    target: bpy.props.StringProperty(
        name="Target", description="Name of the object that holds; empty makes an empty at each bone's tail", options={'SKIP_SAVE'}
    )
    target_bone: bpy.props.StringProperty(
        name="Target Bone", description="Name of a bone of the target, whose head holds", options={'SKIP_SAVE'}
    )
    weight: factor("Weight", "How fast the pins hold", 1.0)

    @classmethod
    def check_offer(cls, context):
        rig = rig_with(context, "")
        chosen.check_editable(rig)
        _pinned(context, rig, "", "")

    def run(self, context):
        rig = rig_with(context, self.object)
        chosen.check_editable(rig)
        check_finite(self, ("weight",))
        names = _pinned(context, rig, self.object, self.bones)
        goal = self._goal()
        for name in names if goal else ():
            chain = next((chain for chain in groups.chains(rig) if name in chain.pinnable), None)
            if chain:
                pins.check_holds(rig, name, chain.names, *goal)
        made = [] if goal else [name for name in names if not _has_target(rig, name)]
        if made:
            check_evaluated(rig, context.view_layer)
        changes = {name: dict(zip(("target", "target_bone"), goal or ())) | self.given(("weight",)) for name in names}
        for name in made:
            changes[name] |= {"target": _new_target(context, rig, name), "target_bone": ""}
        with entries.at_once(setup.system(), rig):
            for name in names:
                setup.pin(rig, name, changes[name])
        pin = rig.motus.chains.pins[names[0]]
        self.show_used(pin, ("weight",))
        one = tr("{bone} is pinned to {target}").format(bone=names[0], target=pin.target.name)
        self.report({'INFO'}, counted(len(names), one, tr("{count} bones are pinned")))
        _warn(self, context, rig)

    def _goal(self):
        """Return (object, bone or "") that the keywords name; None if they name none."""
        if not self.target:
            if self.target_bone:
                raise Refused(tr("Name the armature of the bone {bone}").format(bone=self.target_bone))
            return None
        found = named(self.target)
        if self.target_bone:
            check_bone(found, self.target_bone)
        return found, self.target_bone


def _pinned(context, rig, name, bones):
    """List the names of the bones that are to be pinned. Raises Refused if one belongs to no chain.

    name: of the rig; if it is given, the selection does not count.
    """
    chosen = bone_entries.names_in(rig, bones) if bones else bone_entries.posed(context) if not name else []
    hanging = {one for chain in groups.chains(rig) for one in chain.pinnable} if chosen else ()
    for one in chosen:
        if one not in hanging:
            raise Refused(tr("{bone} belongs to no chain").format(bone=one))
    if chosen:
        return chosen
    entry = entries.active(rig, "chains")
    shown = next((chain for chain in groups.chains(rig) if chain.entry == entry and properties.is_bone(entry)), None)
    if shown is None:
        raise Refused(tr("Select bones of chains: pins hold these alone"))
    return [shown.names[-1]]


def _has_target(rig, name):
    pin = rig.motus.chains.pins.get(name)
    return pin is not None and pins.goal(pin) is not None


def _new_target(context, rig, name):
    """Make an empty at the tail of a posed bone, which is to hold it. Returns the empty."""
    evaluated = rig.evaluated_get(context.view_layer.depsgraph)
    head, tail = (evaluated.matrix_world @ place for place in (evaluated.pose.bones[name].head, evaluated.pose.bones[name].tail))
    empty = targets.new_empty(context, rig, f"{rig.name} {name} Pin", pins.MADE_KEY)
    empty.empty_display_size = TARGET_SIZE * (tail - head).length
    empty.location = tail
    return empty


class MOTUS_OT_chains_unpin(OfARig, bpy.types.Operator):
    bl_idname = "motus.chains_unpin"
    bl_label = "Unpin Chain"
    bl_description = (
        "Remove pins of chains: of the selected bones in Pose Mode, else all of the rig; an empty that was made for a pin goes along"
    )
    rig_with = staticmethod(rig_with)

    bones: bpy.props.StringProperty(
        name="Bones",
        description="Names of the bones whose pins are removed, with commas between; empty takes the selected ones, and without any all",
        options={'SKIP_SAVE'},
    )
    index: bpy.props.IntProperty(
        name="Index", description="Index of the one pin that is removed", default=-1, min=-1, options={'SKIP_SAVE', 'HIDDEN'}
    )

    @classmethod
    def check_offer(cls, context):
        rig = rig_with(context, "")
        chosen.check_editable(rig)
        cls._indices(context, rig, "", "", -1)

    def run(self, context):
        rig = rig_with(context, self.object)
        chosen.check_editable(rig)
        check_no_tweak_mode(rig)
        indices = self._indices(context, rig, self.object, self.bones, self.index)
        setup.unpin(rig, indices)

    @staticmethod
    def _indices(context, rig, name, bones, index):
        """Return the indices of the pins that are to be removed. Raises Refused if there are none."""
        found = list(range(len(rig.motus.chains.pins)))
        names = [one.strip() for one in bones.split(",")] if bones else bone_entries.posed(context) if not name else []
        if index >= 0:
            found = [one for one in found if one == index]
        elif names:
            found = [one for one in found if rig.motus.chains.pins[one].name in names]
        if not found:
            raise Refused(tr("There is no such pin"))
        return found


class MOTUS_OT_chains_mirror(OfARig, bpy.types.Operator):
    bl_idname = "motus.chains_mirror"
    bl_label = "Mirror Chains"
    bl_description = (
        "Give bones of the other side, found by their names, the settings and pins of the chains of the selected bones, or else of all "
        "chains of the rig; chains that are missing there are added"
    )
    needs_native = True
    rig_with = staticmethod(rig_with)

    bones: bpy.props.StringProperty(
        name="Bones",
        description="Names of bones whose chains are mirrored, with commas between; empty takes the selected bones, and without any all chains",
        options={'SKIP_SAVE'},
    )

    @classmethod
    def check_offer(cls, context):
        cls._sides(context, rig_with(context, ""), "", "")

    def run(self, context):
        rig = rig_with(context, self.object)
        sides = self._sides(context, rig, self.object, self.bones)
        mirroring.check(rig, sides)
        mirroring.mirror(rig, sides)
        one = tr("{bone} hangs as {other} does").format(bone=sides[0].other, other=sides[0].name)
        self.report({'INFO'}, counted(len(sides), one, tr("{count} chains mirrored")))
        _warn(self, context, rig)

    @staticmethod
    def _sides(context, rig, name, bones):
        """List the mirroring.Sides of the chains that are meant. Raises Refused if there are none. name: of the rig, or ""."""
        chosen.check_editable(rig)
        names = bone_entries.names_in(rig, bones) if bones else bone_entries.posed(context) if not name else []
        return mirroring.sides(rig, names)


classes = (MOTUS_OT_chains_add, MOTUS_OT_chains_remove, MOTUS_OT_chains_pin, MOTUS_OT_chains_unpin, MOTUS_OT_chains_mirror)
