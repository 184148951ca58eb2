"""Operators that add dynamics to objects, bones and properties, remove dynamics, and set their loops."""

import bpy

from ..core import wiring
from ..core.interface.operators import OBJECT_OR_POSE_MODE, FindsValues, Operator, object_keyword
from ..core.refusals import Refused, check_finite, check_local, check_no_tweak_mode
from ..core.translations import tr
from . import filters, rows, setup, styles, targets, told
from .properties import KEYWORDS, DynamicsKeywords

OF_OVERSHOOT = "overshoot", "settling"
OF_SPRING = "mass", "stiffness", "resistance"
WAYS = filters.NUMBERS[:2], OF_OVERSHOOT, OF_SPRING
"""Groups of the operator's keywords, each of which alone determines the filter."""
NOT_OF_A_PROPERTY = "bones", "whole_chains", "chain_delay", "follow", "channels"


def _bones(description):
    return bpy.props.StringProperty(name="Bones", description=description, options={'SKIP_SAVE'})


def _only_active():
    return bpy.props.BoolProperty(
        name="Only Active", description="Act on the active entry of the list alone", default=False, options={'SKIP_SAVE', 'HIDDEN'}
    )


class _OnProperty:
    """Mixin of operators with the keywords that name a single property of the object."""

    data_path: bpy.props.StringProperty(
        name="Data Path",
        description="Path from the object of a single property, which follows in place of the object",
        options={'SKIP_SAVE'},
    )
    index: bpy.props.IntProperty(
        name="Index", description="Index of a number in an array property; -1 for all of it", default=-1, min=-1, options={'SKIP_SAVE'}
    )


class MOTUS_OT_dynamics_add(FindsValues, DynamicsKeywords, _OnProperty, bpy.types.Operator):
    bl_idname = "motus.dynamics_add"
    bl_label = "Add Dynamics"
    bl_description = "Let objects, bones or a property follow their animation with weight, swing and overshoot"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}
    modes = OBJECT_OR_POSE_MODE
    needs_native = True
    redo = rows.ADDING
    for_scripts = (*OF_OVERSHOOT, *OF_SPRING)

    object: object_keyword("Name of the object; empty takes the selected ones, in Pose Mode the selected bones")
    bones: _bones("Names of bones of the object, with commas between")
    style: bpy.props.EnumProperty(
        name="Style",
        description="Named set of frequency, damping and response, in place of those that are given",
        items=styles.ITEMS,
        default=styles.CUSTOM,
    )
    whole_chains: bpy.props.BoolProperty(
        name="Whole Chains", description="Add dynamics to all bones below the selected ones too", default=False
    )
    chain_delay: bpy.props.FloatProperty(
        name="Delay per Bone",
        description="Time by which each bone of a chain follows later than its parent",
        default=0.0,
        min=0.0,
        soft_max=0.2,
        unit='TIME_ABSOLUTE',
        precision=3,
    )
    # SKIP_SAVE keeps the following numbers out of presets: each group of them sets frequency and damping a second time.
    overshoot: bpy.props.FloatProperty(
        name="Overshoot",
        description="How far the motion goes beyond a step, as a part of the step; with Settling in place of frequency and damping",
        default=0.2,
        min=0.0,
        max=0.95,
        options={'SKIP_SAVE'},
    )
    settling: bpy.props.FloatProperty(
        name="Settling",
        description="Time until the motion comes to rest",
        default=1.0,
        min=filters.LEAST_SETTLING,
        unit='TIME_ABSOLUTE',
        options={'SKIP_SAVE'},
    )
    mass: bpy.props.FloatProperty(
        name="Mass",
        description="Mass that hangs on a spring, in place of frequency, damping and response",
        default=1.0,
        min=1e-3,
        unit='MASS',
        options={'SKIP_SAVE'},
    )
    stiffness: bpy.props.FloatProperty(
        name="Stiffness",
        description="Stiffness of the spring, in N/m: a stiffer one swings more quickly",
        default=100.0,
        min=1e-6,
        options={'SKIP_SAVE'},
    )
    resistance: bpy.props.FloatProperty(
        name="Resistance",
        description="Resistance of the damper, in N·s/m: a larger one ends the swinging sooner",
        default=5.0,
        min=0.0,
        options={'SKIP_SAVE'},
    )

    @classmethod
    def check_offer(cls, context):
        for owner, names in targets.wanted(context, "", "", False).items():
            targets.check_editable(owner)
            targets.check_free(owner, names)

    def run(self, context):
        changes = self._changes(context)
        if self.data_path:
            made = self._property(context, changes)
        else:
            wanted = targets.wanted(context, self.object, self.bones, self.whole_chains)
            made = {owner: self._entries(owner, names, changes) for owner, names in wanted.items()}
        for owner, found in made.items():
            setup.add(owner, found)
        self._show_used(made)
        self._report(context, made)

    def _changes(self, context):
        """Return {name: value} of the settings of an entry that the operator's keywords give."""
        given = [*KEYWORDS, *OF_OVERSHOOT, *OF_SPRING, "chain_delay"]
        check_finite(self, given)
        self._check_one_way()
        targets.check_loop(context, self)
        changes = self.given(KEYWORDS)
        changes.update(zip(filters.NUMBERS, self._numbers()))
        if self.is_given("mass"):
            changes["mass"] = self.mass
        if self.use_loop:
            changes = dict(zip(("loop_start", "loop_end"), targets.loop_of(context.scene))) | changes
        return changes

    def _check_one_way(self):
        """Refuse keywords of two groups that both determine the filter, such as frequency and mass."""
        given = [next(filter(self.is_given, names)) for names in WAYS if any(map(self.is_given, names))]
        if any(map(self.is_given, OF_SPRING)) and self.is_given("response"):
            given.append("response")
        # If a style is chosen, the redo panel hides frequency, damping and response, and earlier values of these are ignored.
        if any(map(self.is_given, (*OF_OVERSHOOT, *OF_SPRING))) and self.style != styles.CUSTOM:
            given.append("style")
        if len(given) > 1:
            first, second = map(self._label, given[:2])
            raise Refused(tr("{first} and {second} say the same in two ways: give one of them").format(first=first, second=second))

    def _label(self, name):
        return tr(self.properties.bl_rna.properties[name].name)

    def _numbers(self):
        """Return (frequency, damping, response) from the overshoot, spring or style keywords; () if none of these was given."""
        try:
            if any(map(self.is_given, OF_OVERSHOOT)):
                return filters.from_overshoot(self.overshoot, self.settling, self.response)
            if any(map(self.is_given, OF_SPRING)):
                return filters.from_spring(self.mass, self.stiffness, self.resistance)
        except ValueError as error:
            raise Refused(str(error)) from error
        return styles.NUMBERS.get(self.style, ()) if self.is_given("style") else ()

    def _entries(self, owner, names, changes):
        """Return {name: settings of its new entry} for bones, or for the object by the name ""; refuses what cannot have dynamics."""
        targets.check_editable(owner)
        targets.check_free(owner, names)
        found, chains = {}, targets.chains(owner, names)
        for name in names:
            thing = owner.pose.bones[name] if name else owner
            chain, depth = chains[name]
            entry = {"chain": chain, **changes}
            if setup.find(owner.motus.dynamics, name) < 0:
                entry.setdefault("follow", _what_to_follow(thing))
            if depth and self.chain_delay > 0.0:
                entry["delay"] = self.delay + depth * self.chain_delay
            found[name] = entry
        targets.check_no_loop(owner, [name for name in names if name == chains[name][0]], changes.get("follow", 'WORLD'))
        return found

    def _property(self, context, changes):
        """Return {owner: {(path, index): settings of the entry}} for the property that the keywords name."""
        for name in NOT_OF_A_PROPERTY:
            if self.is_given(name):
                raise Refused(tr("{name} does not go with a single property").format(name=self._label(name)))
        owner, followed = targets.property_of(context, self.object, self.data_path, self.index)
        targets.check_editable(owner)
        return {owner: {followed: changes}}

    def _show_used(self, made):
        """Copy the settings of the first new entry to the operator, so that the redo panel shows them."""
        owner, found = next(iter(made.items()))
        settings = owner.motus.dynamics
        self.show_used(settings.entries[setup.find(settings, next(iter(found)))], KEYWORDS)

    def _report(self, context, made):
        count = sum(map(len, made.values()))
        if count == 1:
            ((owner, found),) = made.items()
            settings = owner.motus.dynamics
            entry = settings.entries[setup.find(settings, next(iter(found)))]
            self.report({'INFO'}, tr("Dynamics added to {object}").format(object=setup.label(entry)))
        else:
            are_bones = all(isinstance(name, str) and name for found in made.values() for name in found)
            sentence = tr("Dynamics added to {count} bones") if are_bones else tr("Dynamics added to {count} objects")
            self.report({'INFO'}, sentence.format(count=count))
        context.view_layer.update()
        depsgraph = context.view_layer.depsgraph
        problems = [
            (owner, wiring.problem(setup.system(), owner, depsgraph)) for owner in made if owner.evaluated_get(depsgraph).is_evaluated
        ]
        for sentence in sorted({told.sentence(owner, problem, context.scene) for owner, problem in problems if problem}):
            self.report({'WARNING'}, sentence)


def _what_to_follow(thing):
    """Return the default of `follow` for an Object or PoseBone: 'WORLD' for a bone.

    An object with a parent and without its own animation follows in the 'WORLD' as well, any other object its 'OWN' channels.
    """
    if thing != thing.id_data:
        return 'WORLD'
    return 'WORLD' if thing.parent and not targets.has_own_animation(thing) else 'OWN'


class MOTUS_OT_dynamics_remove(Operator, _OnProperty, bpy.types.Operator):
    bl_idname = "motus.dynamics_remove"
    bl_label = "Remove Dynamics"
    bl_description = "Remove dynamics from objects, bones or properties"
    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Name of the object; empty takes the selected ones, in Pose Mode the selected bones")
    bones: _bones("Names of bones of the object, with commas between; empty takes all that follows")
    only_active: _only_active()

    @classmethod
    def check_offer(cls, context):
        cls._owners(context, "")

    def run(self, context):
        owners = self._owners(context, self.object, bool(self.data_path))
        found = {}
        for owner in owners:
            targets.check_editable(owner)
            check_no_tweak_mode(owner)
            found[owner] = targets.indices_for(context, owner, self, bool(self.object))
            targets.check_removable(owner, found[owner])
        for owner, indices in found.items():
            setup.remove(owner, indices)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=", ".join(owner.name for owner in found)))

    @staticmethod
    def _owners(context, name, is_one=False):
        if name or context.mode == 'POSE' or is_one:
            return [targets.owner_with(context, name)]
        found = [obj for obj in context.selected_objects if obj.motus.dynamics.entries]
        if not found:
            raise Refused(tr("Nothing here has dynamics"))
        return found


class MOTUS_OT_dynamics_loop(Operator, _OnProperty, bpy.types.Operator):
    bl_idname = "motus.dynamics_loop"
    bl_label = "Loop over the Scene"
    bl_description = "Let the motion close without a seam over the scene's frames, where the animation does"
    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Name of the object; empty takes the active one")
    bones: _bones("Names of bones of the object, with commas between; empty takes all that follows")
    only_active: _only_active()

    @classmethod
    def check_offer(cls, context):
        check_local(targets.owner_with(context, ""))

    def run(self, context):
        owner, scene = targets.owner_with(context, self.object), context.scene
        targets.check_editable(owner)
        for index in targets.indices_for(context, owner, self, True):
            entry = owner.motus.dynamics.entries[index]
            (entry.loop_start, entry.loop_end), entry.use_loop = targets.loop_of(scene), True


classes = (MOTUS_OT_dynamics_add, MOTUS_OT_dynamics_remove, MOTUS_OT_dynamics_loop)
