"""Operators that add motion drivers to properties and remove them."""

import bpy

from ..core.blender import capabilities, datablocks
from ..core.interface.operators import Operator
from ..core.interface.view import hovered
from ..core.measures import units
from ..core.refusals import Refused, check_finite, check_local
from ..core.translations import tr
from . import expressions, history, places, preview
from .keywords import NAMES, REDO, DriverKeywords, given

WIDTH = 360
"""Width of the dialog, in pixels at the interface's normal size."""


class _OnProperty(datablocks.OfADatablock):
    """Mixin of the operators that act on one property, with the keywords that name it."""

    channel: bpy.props.EnumProperty(
        name="Channel",
        description="Property of the object that is driven, if no data path is given",
        items=places.CHANNELS,
        default=places.BY_PATH,
        options={'SKIP_SAVE'},
    )

    def properties_meant(self, context):
        """Return the numbers (Places) of the property that the keywords name. Raises Refused if there is no such property."""
        datablock = self.id_data(context)
        check_local(datablock)
        path, index = self.data_path, self.index
        if not path:
            if self.channel == places.BY_PATH:
                raise Refused(tr("Point at a property with the mouse, or give its data path"))
            path, index = places.of_channel(datablock, self.channel)
        return places.find(datablock, path, index)

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
        manager = context.window_manager
        if self.replace and capabilities.has_dialog_titles():
            return manager.invoke_props_dialog(self, width=WIDTH, title="Edit Motion Driver")
        return manager.invoke_props_dialog(self, width=WIDTH)

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

    def draw_below(self, _context):
        preview.draw(self.layout, self)

    def run(self, context):
        found = self.properties_meant(context)
        check_finite(self, given(self))
        for place in found:
            if place.curve and not self.replace:
                raise Refused(_is_driven(place))
        self._check()
        keywords = given(self) | self._in_unit(context.scene)
        texts = [self._text(place, number, keywords) for number, place in enumerate(found)]
        for place, text in zip(found, texts):
            try:
                place.add(text)
            except TypeError as error:
                raise Refused(str(error)) from error
        function = expressions.BY_IDENTIFIER[self.function]
        self.report(
            {'INFO'}, tr("{property} is now driven by {function}").format(property=places.label(found), function=tr(function.label))
        )

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
            known = place.curve and expressions.read(place.curve.driver.expression)
            keywords["base"] = known["base"] if known else float(place.value)
        keywords["seed"] += number
        if not keywords["source"]:
            keywords["source"], keywords["source_index"] = place.path, max(place.index, 0)
        return keywords

    def _check(self):
        """Raise Refused with the driver function's message if the function does not accept the arguments."""
        try:
            preview.sample(given(self), [0.0])
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
        found = [place for place in meant if place.curve and expressions.names_ours(place.curve.driver.expression)]
        if not found and not gone:
            raise Refused(_has_none(self.data_path or datablock.name))
        depsgraph = context.evaluated_depsgraph_get()
        for place, value in [(place, place.evaluated(depsgraph)) for place in found]:
            place.remove()
            place.rest_at(value)
        for one in gone:
            one.remove()


def _has_none(name):
    return tr("{path} has no motion driver").format(path=name)


classes = (MOTUS_OT_driver_add, MOTUS_OT_driver_remove)
