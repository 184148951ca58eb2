"""The snow that falls on the village, and what lies of it."""

import bpy

from ...core.blender import node_groups
from ..stage import materials


def add(context, collection, covered, clouds, ahead, lifetime, cover):
    """Gentle snow, and what lies of it, by the public operators; gives the name of what lies.

    ahead: s before the scene in which it begins to snow.
    """
    view_layer = context.view_layer
    view_layer.active_layer_collection = view_layer.layer_collection.children[collection.name]
    emitters = []
    for name, place, radius, rate, seed in clouds:
        if bpy.ops.motus.snow_add(
            preset="GENTLE",
            location=place,
            cone_radius=radius,
            rate=rate,
            seed=seed,
            lifetime=lifetime,
            start_frame=1.0 - ahead * context.scene.render.fps,
        ) != {"FINISHED"}:
            raise RuntimeError("The snow could not be added")
        context.object.name = name
        emitters.append(context.object.name)  # in a file with a scene that was built before it is another one
        _keep_flakes_out_of_shadow_maps(context.object)
    if bpy.ops.motus.snow_cover_add(collection=covered.name, emitters=",".join(emitters), lands=False, **cover) != {"FINISHED"}:
        raise RuntimeError("The snow that lies could not be added")
    return context.object.name


def _keep_flakes_out_of_shadow_maps(emitter):
    """EEVEE before 4.2 draws all flakes into the shadow map of each lamp, on each frame anew, which takes as long as all the rest."""
    given = [
        value
        for modifier in emitter.modifiers
        if modifier.type == "NODES" and modifier.node_group
        for value in node_groups.inputs_of(modifier)
    ]
    for shape in given:
        if isinstance(shape, bpy.types.Object) and shape.type == "MESH":
            for material in filter(None, shape.data.materials):
                materials.cast_no_shadows(material)
