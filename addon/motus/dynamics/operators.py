"""Operators that give objects and bones dynamics, and take them back."""

import bpy

from ..core import wiring
from ..core.operators import OBJECT_OR_POSE_MODE, Operator, object_keyword
from ..core.refusals import Refused, check_finite, check_local, check_no_tweak_mode
from ..core.translations import tr
from . import filters, rows, setup, styles, targets
from .properties import KEYWORDS, DynamicsKeywords

OF_OVERSHOOT = "overshoot", "settling"
OF_SPRING = "mass", "stiffness", "resistance"


def _bones(description):
    return bpy.props.StringProperty(name="Bones", description=description, options={'SKIP_SAVE'})


class _OnProperty:
    """Mixin: what is passed on to the driver of a single property."""

    data_path: bpy.props.StringProperty(
        name="Data Path", description="Path of a single property from the object, which is followed by a driver",
        options={'SKIP_SAVE'})
    index: bpy.props.IntProperty(
        name="Index", description="Index of a number in an array property; -1 for all of it", default=-1, min=-1,
        options={'SKIP_SAVE'})

    def _property(self):
        """Keywords of motus.driver_add and motus.driver_remove that name the property."""
        return {"datablock": self.object or bpy.context.object.name, "data_path": self.data_path, "index": self.index}


class MOTUS_OT_dynamics_add(Operator, DynamicsKeywords, _OnProperty, bpy.types.Operator):
    bl_idname = "motus.dynamics_add"
    bl_label = "Add Dynamics"
    bl_description = "Let objects or bones follow their animation with weight, swing and overshoot"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}
    modes = OBJECT_OR_POSE_MODE
    needs_native = True
    redo = rows.ADDING
    for_scripts = (*OF_OVERSHOOT, *OF_SPRING)

    object: object_keyword("Name of the object; empty takes the selected ones, in Pose Mode the selected bones")
    bones: _bones("Names of bones of the object, with commas between")
    style: bpy.props.EnumProperty(
        name="Style", description="Frequency, damping and response that go by a name", items=styles.ITEMS,
        default=styles.CUSTOM)
    whole_chains: bpy.props.BoolProperty(
        name="Whole Chains", description="Take all bones below along", default=False)
    chain_delay: bpy.props.FloatProperty(
        name="Delay per Bone", description="How much later each bone of a chain follows than the one above it", default=0.0,
        min=0.0, soft_max=0.2, unit='TIME_ABSOLUTE', precision=3)
    overshoot: bpy.props.FloatProperty(
        name="Overshoot", description="How far it goes beyond a step, as a part of the step: with Settling in place of "
        "frequency and damping", default=0.2, min=0.0, max=0.95)
    settling: bpy.props.FloatProperty(
        name="Settling", description="How long it takes to come to rest", default=1.0, min=filters.LEAST_SETTLING,
        unit='TIME_ABSOLUTE')
    mass: bpy.props.FloatProperty(
        name="Mass", description="What hangs on a spring, in place of frequency, damping and response", default=1.0,
        min=1e-3, unit='MASS')
    stiffness: bpy.props.FloatProperty(name="Stiffness", description="Of the spring, N/m", default=100.0, min=1e-6)
    resistance: bpy.props.FloatProperty(name="Resistance", description="Of the damper, N s/m", default=5.0, min=0.0)

    @classmethod
    def check_offer(cls, context):
        for owner, names in targets.wanted(context, "", "", False).items():
            targets.check_editable(owner)
            targets.check_free(owner, names)

    def run(self, context):
        changes = self._changes(context)
        if self.data_path:
            self._drive(changes)
            return
        wanted = targets.wanted(context, self.object, self.bones, self.whole_chains)
        made = {owner: self._entries(owner, names, changes) for owner, names in wanted.items()}
        for owner, found in made.items():
            setup.add(owner, found)
        self._report(context, made)

    def _changes(self, context):
        """Settings of an entry that were given, by name."""
        given = [*KEYWORDS, *OF_OVERSHOOT, *OF_SPRING, "chain_delay"]
        check_finite(self, given)
        changes = self.given(KEYWORDS)
        changes.update(zip(filters.NUMBERS, self._numbers()))
        if self.is_given("mass"):
            changes["mass"] = self.mass
        if self.use_loop:
            changes.setdefault("loop_start", context.scene.frame_start)
            changes.setdefault("loop_end", context.scene.frame_end + 1)
        return changes

    def _numbers(self):
        """(frequency, damping, response) as they were given; () where none of them was."""
        try:
            if any(map(self.is_given, OF_OVERSHOOT)):
                return filters.from_overshoot(self.overshoot, self.settling, self.response)
            if any(map(self.is_given, OF_SPRING)):
                return filters.from_spring(self.mass, self.stiffness, self.resistance)
        except ValueError as error:
            raise Refused(str(error)) from error
        return styles.NUMBERS.get(self.style, ()) if self.is_given("style") else ()

    def _entries(self, owner, names, changes):
        """{name: settings of the entry}; refuses what cannot follow."""
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

    def _drive(self, changes):
        """Let a single property be followed by a driver, which reads its keys."""
        numbers = {name: changes.get(name, getattr(self, name)) for name in filters.NUMBERS}
        keywords = {"frequency": numbers["frequency"], "damping_ratio": numbers["damping"], "response": numbers["response"]}
        try:
            bpy.ops.motus.driver_add(function='SECOND_ORDER', **self._property(), **keywords)
        except RuntimeError as error:
            raise Refused(_sentence(error)) from error

    def _report(self, context, made):
        count = sum(map(len, made.values()))
        if count == 1:
            (owner, found), = made.items()
            self.report({'INFO'}, tr("{object} has dynamics").format(object=next(iter(found)) or owner.name))
        else:
            self.report({'INFO'}, tr("{count} things have dynamics").format(count=count))
        context.view_layer.update()
        depsgraph = context.view_layer.depsgraph
        problems = {wiring.problem(setup.system(), owner, depsgraph) for owner in made
                    if owner.evaluated_get(depsgraph).is_evaluated}
        for sentence in sorted(problem.sentence for problem in problems if problem):
            self.report({'WARNING'}, tr(sentence))


def _what_to_follow(thing):
    """The motion that is meant where nobody says: a bone's in the world; an object's own, where it has one."""
    if thing != thing.id_data:
        return 'WORLD'
    return 'WORLD' if thing.parent and not targets.has_own_animation(thing) else 'OWN'


def _sentence(error):
    """What an operator has reported as it was called by a script."""
    return str(error).strip().partition("Error: ")[2] or str(error)


class MOTUS_OT_dynamics_remove(Operator, _OnProperty, bpy.types.Operator):
    bl_idname = "motus.dynamics_remove"
    bl_label = "Remove Dynamics"
    bl_description = "Leave objects or bones to their own animation again"
    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Name of the object; empty takes the selected ones, in Pose Mode the selected bones")
    bones: _bones("Names of bones of the object, with commas between; empty takes all that follows")

    @classmethod
    def check_offer(cls, context):
        cls._owners(context, "")

    def run(self, context):
        if self.data_path:
            try:
                bpy.ops.motus.driver_remove(**self._property())
            except RuntimeError as error:
                raise Refused(_sentence(error)) from error
            return
        owners = self._owners(context, self.object)
        found = {}
        for owner in owners:
            targets.check_editable(owner)
            check_no_tweak_mode(owner)
            found[owner] = targets.indices_for(context, owner, self.bones, bool(self.object))
            targets.check_removable(owner, found[owner])
        for owner, indices in found.items():
            setup.remove(owner, indices)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=", ".join(owner.name for owner in found)))

    @staticmethod
    def _owners(context, name):
        if name or context.mode == 'POSE':
            return [targets.owner_with(context, name)]
        found = [obj for obj in context.selected_objects if obj.motus.dynamics.entries]
        if not found:
            raise Refused(tr("Nothing here has dynamics"))
        return found


class MOTUS_OT_dynamics_loop(Operator, bpy.types.Operator):
    bl_idname = "motus.dynamics_loop"
    bl_label = "Loop over the Scene"
    bl_description = "Let the motion close without a seam over the scene's frames, where the animation does"
    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Name of the object; empty takes the active one")
    bones: _bones("Names of bones of the object, with commas between; empty takes all that follows")

    @classmethod
    def check_offer(cls, context):
        check_local(targets.owner_with(context, ""))

    def run(self, context):
        owner, scene = targets.owner_with(context, self.object), context.scene
        targets.check_editable(owner)
        for index in targets.indices_for(context, owner, self.bones, True):
            entry = owner.motus.dynamics.entries[index]
            entry.loop_start, entry.loop_end, entry.use_loop = scene.frame_start, scene.frame_end + 1, True


class MOTUS_OT_dynamics_refresh(Operator, bpy.types.Operator):
    bl_idname = "motus.dynamics_refresh"
    bl_label = "Refresh"
    bl_description = "Wire the object again, after its bones or parents were changed"
    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Name of the object; empty takes the active one")

    @classmethod
    def check_offer(cls, context):
        check_local(targets.owner_with(context, ""))

    def run(self, context):
        owner = targets.owner_with(context, self.object)
        check_local(owner)
        wiring.refresh(setup.system(), owner)


classes = (MOTUS_OT_dynamics_add, MOTUS_OT_dynamics_remove, MOTUS_OT_dynamics_loop, MOTUS_OT_dynamics_refresh)
