"""Operators that add motion drivers to properties and remove them."""

import bpy

from ..core.blender import capabilities, datablocks
from ..core.interface import ui
from ..core.interface.operators import Operator
from ..core.interface.rows import Rows
from ..core.interface.view import hovered
from ..core.measures import scene_time, units
from ..core.refusals import Refused, check_finite, check_local
from ..core.translations import tr
from . import copying, expressions, history, places, preview, trial, writing
from .keywords import NAMES, REDO, DriverKeywords, given

WIDTH = 360
"""Width of the dialog, in pixels at the interface's normal size."""
SEEDS = 16
"""Distance of the seeds of two copies: more than a vector has components, which have seeds of their own."""


class _OnProperty(datablocks.OfADatablock):
    """Mixin of the operators that act on one property, with the keywords that name it."""

    channel: bpy.props.EnumProperty(
        name="Channel",
        description="Property of the object that is driven, if no data path is given",
        items=places.CHANNELS,
        default=places.BY_PATH,
        options={'SKIP_SAVE'},
    )

    def named(self, context):
        """Return (datablock, data path, index) of the property that the keywords name. Raises Refused if they name none."""
        datablock = self.id_data(context)
        check_local(datablock)
        path, index = self.data_path, self.index
        if not path:
            if self.channel == places.BY_PATH:
                raise Refused(tr("Point at a property with the mouse, or give its data path"))
            path, index = places.of_channel(datablock, self.channel)
        return datablock, path, index

    def properties_meant(self, context):
        """Return the numbers (Places) of the property that the keywords name. Raises Refused if there is no such property."""
        return places.find(*self.named(context))

    def take_hovered(self, context):
        """Store the property under the mouse in the keywords, so that the operator finds it again when it is redone.

        If the keywords name a property already, nothing is stored. Returns False if no property is known.
        """
        found = None if self.data_path else hovered.find(context)
        if found is None:
            return bool(self.data_path)
        datablock, path, self.index = found
        datablock, self.data_path = datablocks.named_by(datablock, path)
        self.datablock, self.collection = datablock.name, datablocks.collection_of(datablock)
        return True


class MOTUS_OT_driver_add(_OnProperty, DriverKeywords, Operator, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.driver_add"
    bl_label = "Add Motion Driver"
    bl_description = "Let a property swing, ease or wander by itself"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}
    needs_native = True
    redo = REDO
    for_scripts = ("replace", "source_index")
    _trial = None
    """Trial of the motion while the dialog is open; None at all other times."""

    live: bpy.props.BoolProperty(
        name="Live Preview", description="Play the scene with this motion while the dialog is open", default=True, options={'HIDDEN'}
    )
    replace: bpy.props.BoolProperty(name="Replace", description="Replace the driver that the property has", options={'SKIP_SAVE'})

    @classmethod
    def check_offer(cls, context):
        if context.object is None:
            raise Refused(tr("Select an object, or name one"))
        check_local(context.object)

    def invoke(self, context, _event):
        try:
            if not self.take_hovered(context) and self.channel == places.BY_PATH:
                self.channel = places.free_channel(self.id_data(context))
            self._take_up(context, self.properties_meant(context))
        except Refused as refusal:
            return self.refuse(refusal)
        self._trial = trial.Trial()
        self._try(context)
        manager = context.window_manager
        if self.replace and capabilities.has_dialog_titles():
            return manager.invoke_props_dialog(self, width=WIDTH, title="Edit Motion Driver")
        return manager.invoke_props_dialog(self, width=WIDTH)

    def check(self, context):
        """Show what the changed keywords give. Blender calls this method after each change in the dialog."""
        self._try(context)
        return True

    def cancel(self, _context):
        self._end_trial()

    def _try(self, context):
        """Have the motion act on the property while the dialog is open, if the user wants that and the keywords make a motion."""
        if self._trial is None:
            return
        if not self.live:
            self._trial.end()
            return
        self._trial.take_back()
        try:
            for place, text in self._made(context):
                self._trial.put(place, text)
        except Refused:
            self._trial.take_back()
        else:
            self._trial.begin(context)

    def _end_trial(self):
        if self._trial is not None:
            self._trial.end()
            self._trial = None

    def _take_up(self, context, found):
        """Copy the keywords of the motion driver that the property has into the operator.

        Without a driver, `base` becomes the property's present value, and the remaining keywords get defaults that suit the scene. Raises
        Refused if the property has a driver that is no motion driver.
        """
        curve = found[0].curve if self.data_path else None
        known = curve and expressions.read(curve.driver.expression)
        if curve and not known:
            raise Refused(_is_driven(found[0]))
        if known:
            for name, value in known.items():
                setattr(self, name, value)
            self.replace = True
            return
        if len(found) == 1 and self.data_path and not self.is_given("base"):
            self.base = float(found[0].value)
        for name, value in self._in_unit(context.scene).items():
            setattr(self, name, value)
        if context.scene.use_gravity and units.is_gravity_meant(context.scene) and not self.is_given("gravity"):
            self.gravity = context.scene.gravity.length

    def _in_unit(self, scene):
        """Return {keyword: default} with defaults converted to the scene's unit, for keywords that the caller has not given."""
        return units.defaults(scene, self.properties, [name for name in NAMES if not self.is_given(name)])

    def draw_below(self, context):
        if self._trial is not None:
            self.layout.prop(self, "live")
        try:
            place = self.properties_meant(context)[0]
        except Refused as refusal:
            ui.draw_message(self.layout, str(refusal), 'ERROR')
        else:
            preview.draw(self.layout, self._for_component(given(self), place, 0), context.scene, place.unit)

    def run(self, context):
        self._end_trial()
        made = self._made(context)
        for place, text in made:
            place.add(text)
        function, label = expressions.BY_IDENTIFIER[self.function], places.label([place for place, _ in made])
        self.report({'INFO'}, tr("{property} is now driven by {function}").format(property=label, function=tr(function.label)))

    def _made(self, context):
        """[(Place, expression)] of what the keywords make. Raises Refused if they make nothing."""
        found = self.properties_meant(context)
        check_finite(self, given(self))
        for place in found:
            if place.curve and not self.replace:
                raise Refused(_is_driven(place))
        self._check(context.scene)
        keywords = given(self) | self._in_unit(context.scene)
        return [(place, self._text(place, number, keywords)) for number, place in enumerate(found)]

    def _text(self, place, number, keywords):
        keywords = self._for_component(keywords, place, number)
        if expressions.BY_IDENTIFIER[self.function].follows:
            history.check(place.holder, keywords["source"], keywords["source_index"])
        text = expressions.compose(keywords)
        if len(text) > expressions.LONGEST:
            raise Refused(
                tr("The expression has {count} characters, of which a driver takes {most}: shorten the names").format(
                    count=len(text), most=expressions.LONGEST
                )
            )
        return text

    def _for_component(self, keywords, place, number):
        """Return the keywords for one component of an array property.

        place: the component. number: its position among the driven components. Each component has its own value as base, and each noise has
        its own seed.
        """
        keywords = dict(keywords)
        if not self.is_given("base"):
            keywords["base"] = place.base
        keywords["seed"] += number
        if not keywords["source"]:
            keywords["source"], keywords["source_index"] = place.path, max(place.index, 0)
        return keywords

    def _check(self, scene):
        """Raise Refused with the driver function's message if the function does not accept the arguments."""
        try:
            preview.sample(given(self), [0.0], scene_time.seconds(scene, 1.0))
        except ValueError as error:
            raise Refused(str(error)) from error


def _is_driven(place):
    return tr("{path} has a driver already").format(path=place.path)


class MOTUS_OT_driver_remove(_OnProperty, Operator, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.driver_remove"
    bl_label = "Remove Motion Driver"
    bl_description = "Remove the motion drivers of a property, or of all properties of the object; the properties keep their present values"
    for_scripts = ("channel",)

    @classmethod
    def check_offer(cls, context):
        if context.object is None:
            raise Refused(tr("Select an object, or name one"))
        check_local(context.object)
        if not any(found.datablock == context.object for found in places.of_object(context.object)):
            raise Refused(_has_none(context.object.name))

    def invoke(self, context, _event):
        self.take_hovered(context)
        return self.execute(context)

    def run(self, context):
        datablock = self.id_data(context)
        check_local(datablock)
        is_one = bool(self.data_path) or self.channel != places.BY_PATH
        gone = [one for one in places.gone(datablock) if not is_one or one.path == self.data_path]
        meant = self.properties_meant(context) if is_one and not gone else [] if is_one else places.there(datablock)
        found = [place for place in meant if place.is_moved]
        if not found and not gone:
            raise Refused(_has_none(self.data_path or datablock.name))
        depsgraph = context.evaluated_depsgraph_get()
        for place, value in [(place, place.evaluated(depsgraph)) for place in found]:
            place.remove()
            place.rest_at(value)
        for one in gone:
            one.remove()


class MOTUS_OT_driver_copy(_OnProperty, Operator, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.driver_copy"
    bl_label = "Copy Motion Driver to Selected"
    bl_description = "Give the same property of all selected objects or bones the same motion"
    needs_native = True
    redo = (Rows(("own_base", "own_seeds", "delay")),)
    for_scripts = ("channel",)

    own_base: bpy.props.BoolProperty(
        name="Own Base", description="Each copy moves about the value that its property has; otherwise about the same one", default=True
    )
    own_seeds: bpy.props.BoolProperty(name="Own Seeds", description="Each copy has its own seed, so that no two wander alike", default=True)
    delay: bpy.props.FloatProperty(
        name="Delay", description="Frames by which each copy starts later than the one before, in the order of the names"
    )

    @classmethod
    def check_offer(cls, context):
        MOTUS_OT_driver_remove.check_offer(context)

    def invoke(self, context, _event):
        self.take_hovered(context)
        return self.execute(context)

    def run(self, context):
        check_finite(self, {"delay": self.delay})
        datablock, path, index = self.named(context)
        sources = places.find(datablock, path, index)
        if not any(place.is_moved for place in sources):
            raise Refused(_has_none(path))
        number, copied = 0, 0
        for target in copying.targets(context, datablock, path):
            made = copying.copies(sources, (*target, index), lambda known, place, after=number + 1: self._changed(known, place, after))
            for place, text in made:
                place.add(text)
            number, copied = number + bool(made), copied + len(made)
        if not copied:
            raise Refused(tr("Nothing else that is selected has this property without another driver"))
        self.report({'INFO'}, tr("Motion drivers copied: {count}").format(count=copied))

    def _changed(self, known, place, number):
        """Keywords of the copy number `number`, from 1 on, of a motion. known: keywords of the motion. place: of the copy's property."""
        keywords = copying.moved_on(known, number * self.delay)
        if self.own_seeds and "seed" in known:
            keywords["seed"] += number * SEEDS
        if self.own_base and "base" in known:
            keywords["base"] = place.base
        return keywords


class MOTUS_OT_driver_write_out(_OnProperty, Operator, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.driver_write_out"
    bl_label = "Write Out Motion Driver"
    bl_description = "Make motion drivers plain Blender, which needs no Motus: expressions that Blender evaluates without Python, or keys"
    needs_native = True
    redo = (Rows(("as_keys", "tolerance", "frame_start", "frame_end")),)
    for_scripts = ("channel",)

    as_keys: bpy.props.BoolProperty(name="Only Keys", description="Write keys even if an expression could be written")
    tolerance: bpy.props.FloatProperty(
        name="Error",
        description="Largest difference between the motion and its keys, in units of the property; a larger one takes fewer keys",
        default=0.001,
        min=0.0,
        soft_min=1e-6,
        soft_max=0.1,
        precision=4,
    )
    frame_start: bpy.props.IntProperty(name="Start", description="First frame of the keys; by default the scene's", options={'SKIP_SAVE'})
    frame_end: bpy.props.IntProperty(name="End", description="Last frame of the keys; by default the scene's", options={'SKIP_SAVE'})

    @classmethod
    def check_offer(cls, context):
        MOTUS_OT_driver_remove.check_offer(context)

    def invoke(self, context, _event):
        self.take_hovered(context)
        self.frame_start, self.frame_end = context.scene.frame_start, context.scene.frame_end
        return self.execute(context)

    def run(self, context):
        check_finite(self, {"tolerance": self.tolerance})
        found = self._found(context)
        texts = [self._expression(place, context.scene) for place in found]
        keyed = [place for place, text in zip(found, texts) if not text]
        keys = [writing.Keys(place, context.scene, *self._range(context.scene)) for place in keyed]
        for place in keyed:
            _check_keys(place, context.evaluated_depsgraph_get())
        if keys:
            writing.record(context, keys)
        for place, text in zip(found, texts):
            if text:
                place.set_expression(text)
        count = sum(one.write(self.tolerance) for one in keys)
        self.report(
            {'INFO'},
            tr("Written out: expressions {expressions}, properties with keys {properties}, keys {keys}").format(
                expressions=len(found) - len(keys), keys=count, properties=len(keys)
            ),
        )

    def _found(self, context):
        """Places of the motion drivers that are meant: those of a property, or all of the datablock. Raises Refused if there are none."""
        datablock = self.id_data(context)
        check_local(datablock)
        is_one = bool(self.data_path) or self.channel != places.BY_PATH
        meant = self.properties_meant(context) if is_one else places.there(datablock)
        found = [place for place in meant if place.is_moved]
        if not found:
            raise Refused(_has_none(self.data_path or datablock.name))
        return found

    def _expression(self, place, scene):
        keywords = expressions.read(place.curve.driver.expression)
        return writing.expression(keywords, scene) if keywords and not self.as_keys else ""

    def _range(self, scene):
        """First and last frame of the keys, in the keys' time. Raises Refused if there are none, or too many."""
        first = self.frame_start if self.is_given("frame_start") else scene.frame_start
        last = self.frame_end if self.is_given("frame_end") else scene.frame_end
        if not first < last:
            raise Refused(tr("The end must come after the start"))
        if last - first > writing.MOST:
            raise Refused(tr("At most {most} frames are written as keys").format(most=writing.MOST))
        return scene_time.keys_time(scene, first), scene_time.keys_time(scene, last)


def _check_keys(place, depsgraph):
    """Raise Refused if Blender does not evaluate the motion of a property, or keys cannot be inserted."""
    holder = place.holder
    is_shown = not isinstance(holder, bpy.types.Object) or holder.visible_get()
    if not is_shown or not holder.evaluated_get(depsgraph).is_evaluated:
        raise Refused(tr("Blender does not evaluate {object}, which is hidden or not used: show it first").format(object=holder.name))
    if holder.animation_data.action:
        check_local(holder.animation_data.action)


def _has_none(name):
    return tr("{path} has no motion driver").format(path=name)


classes = (MOTUS_OT_driver_add, MOTUS_OT_driver_remove, MOTUS_OT_driver_copy, MOTUS_OT_driver_write_out)
