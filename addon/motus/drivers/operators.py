"""Operators that put drivers on properties and take them off."""

import bpy

from ..core import native
from ..core.refusals import Refused, check_finite, check_local, named
from ..core.translations import tr
from . import expressions, places, preview
from .keywords import DriverKeywords, given


class _OnProperty:
    """Mixin: which property is meant."""

    object: bpy.props.StringProperty(
        name="Object", description="Name of the object with the property; empty takes the active one", options={'SKIP_SAVE'})
    id_type: bpy.props.StringProperty(
        name="ID Type", description="Kind of a datablock that is no object, as driver targets name it, such as MATERIAL",
        options={'SKIP_SAVE'})
    id_name: bpy.props.StringProperty(
        name="ID", description="Name of that datablock", options={'SKIP_SAVE'})
    data_path: bpy.props.StringProperty(
        name="Data Path", description="Path of the property from the datablock; empty takes the property under the mouse",
        options={'SKIP_SAVE'})
    index: bpy.props.IntProperty(
        name="Index", description="Component of an array; -1 takes all of them", default=-1, min=-1,
        options={'SKIP_SAVE'})

    def places(self, context):
        """The Places that are meant. Raises Refused."""
        if not self.data_path:
            self._take_hovered(context)
        datablock = self._datablock(context)
        check_local(datablock)
        return places.find(datablock, self.data_path, self.index)

    def _take_hovered(self, context):
        hovered = places.hovered(context)
        if hovered is None:
            raise Refused(tr("Point at a property with the mouse, or give its data path"))
        datablock, path, self.index = hovered
        # Noted in words, by which the redo panel finds it again.
        datablock, self.data_path = places.named_by(datablock, path)
        if isinstance(datablock, bpy.types.Object):
            self.object = datablock.name
        else:
            self.id_type, self.id_name = places.type_of(datablock), datablock.name

    def _datablock(self, context):
        if not self.id_type:
            found = named(self.object) if self.object else context.object
            if found is None:
                raise Refused(tr("There is no active object"))
            return found
        collection = places.datablocks(self.id_type)
        found = collection.get(self.id_name) if collection is not None else None
        if found is None:
            raise Refused(tr("There is no {name} of the type {type}").format(name=self.id_name, type=self.id_type))
        return found


class MOTUS_OT_driver_add(_OnProperty, DriverKeywords, bpy.types.Operator):
    bl_idname = "motus.driver_add"
    bl_label = "Add Motion Driver"
    bl_description = "Let a property swing, ease or wander by itself"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    replace: bpy.props.BoolProperty(
        name="Replace", description="Take the place of a driver that is there", options={'SKIP_SAVE'})

    def invoke(self, context, _event):
        try:
            found = self.places(context)
            self._take_up(context, found)
        except Refused as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        return context.window_manager.invoke_props_dialog(self, width=360)

    def _take_up(self, context, found):
        """Show what is there: the values of a driver of ours, else the property's own."""
        curve = found[0].curve
        known = curve and expressions.read(curve.driver.expression)
        if curve and not known:
            raise Refused(_is_driven(found[0]))
        if known:
            for name, value in known.items():
                setattr(self, name, value)
            self.replace = True
        elif not self.properties.is_property_set("base"):
            self.base = float(found[0].value)
        if not known and context.scene.use_gravity and not self.properties.is_property_set("gravity"):
            self.gravity = context.scene.gravity.length

    def draw(self, context):
        preview.draw(self.layout, context, self)

    def execute(self, context):
        try:
            found = self.places(context)
            check_finite(self, given(self))
            for place in found:
                if place.curve and not self.replace:
                    raise Refused(_is_driven(place))
            _check(self)
            texts = [expressions.compose(self._keywords(place, number)) for number, place in enumerate(found)]
            for place, text in zip(found, texts):
                place.add(text)
        except (Refused, TypeError) as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        function = expressions.BY_IDENTIFIER[self.function]
        self.report({'INFO'}, tr("{path} is driven by {function}").format(path=found[0].path, function=tr(function.label)))
        return {'FINISHED'}

    def _keywords(self, place, number):
        """The keywords for a component of an array: each swings about its own value, and each noise is another one."""
        keywords = given(self)
        if not self.properties.is_property_set("base") and not place.curve:
            keywords["base"] = float(place.value)
        keywords["seed"] += number
        return keywords


def _is_driven(place):
    return tr("{path} has a driver already").format(path=place.path)


def _check(operator):
    """Refuse what the function itself refuses, in its words."""
    if native.module is None:
        raise Refused(tr(native.status.sentence))
    try:
        preview.sample(given(operator), [0.0])
    except ValueError as error:
        raise Refused(str(error)) from error


class MOTUS_OT_driver_remove(_OnProperty, bpy.types.Operator):
    bl_idname = "motus.driver_remove"
    bl_label = "Remove Motion Driver"
    bl_description = "Take a motion driver off a property, which keeps the value that it has"
    bl_options = {'REGISTER', 'UNDO'}

    def execute(self, context):
        try:
            found = [place for place in self.places(context)
                     if place.curve and expressions.names_ours(place.curve.driver.expression)]
            if not found:
                raise Refused(tr("{path} has no motion driver").format(path=self.data_path))
            depsgraph = context.evaluated_depsgraph_get()
            for place, value in [(place, place.evaluated(depsgraph)) for place in found]:
                place.remove()
                place.rest_at(value)
        except Refused as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        return {'FINISHED'}


classes = (MOTUS_OT_driver_add, MOTUS_OT_driver_remove)
