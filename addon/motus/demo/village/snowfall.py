"""The snow that falls on the village, and the snow cover that lies on it."""

import bpy

from ...core.blender import node_groups
from ..stage import materials


def add(context, collection, covered, clouds, ahead, lifetime, cover):
    """Add gentle snowfall and a snow cover with the public operators. Returns the name of the cover's object.

    covered: collection of objects on which snow lies. clouds: (name, place, half the width, flakes per second, seed) of each; flakes per
    second may be a dictionary {second of the scene: number}, which is keyed. ahead: seconds of snowfall before the scene.
    lifetime: seconds until a flake has come down. cover: keywords for the snow cover.
    """
    view_layer = context.view_layer
    view_layer.active_layer_collection = view_layer.layer_collection.children[collection.name]
    emitters = []
    for name, place, radius, rate, seed in clouds:
        rates = rate if isinstance(rate, dict) else {0.0: rate}
        if bpy.ops.motus.snow_add(
            preset="GENTLE",
            location=place,
            emitter_radius=radius,
            rate=max(rates.values()),
            seed=seed,
            lifetime=lifetime,
            start_frame=1.0 - ahead * context.scene.render.fps,
        ) != {"FINISHED"}:
            raise RuntimeError("The snow could not be added")
        context.object.name = name
        if len(rates) > 1:
            _key_rate(context.object, rates, context.scene)
        emitters.append(context.object.name)  # Blender may have changed the name, if the file already has such a scene
        _keep_flakes_out_of_shadow_maps(context.object)
    if bpy.ops.motus.snow_cover_add(collection=covered.name, emitters=",".join(emitters), lands=False, **cover) != {"FINISHED"}:
        raise RuntimeError("The snow that lies could not be added")
    return context.object.name


def _key_rate(emitter, rates, scene):
    """Key the rate of an emitter. rates: {second of the scene: flakes per second}."""
    for second, rate in rates.items():
        emitter.motus.snow.rate = rate
        emitter.keyframe_insert("motus.snow.rate", frame=1.0 + second * scene.render.fps)


def _keep_flakes_out_of_shadow_maps(emitter):
    """Exclude flakes from the shadow maps of EEVEE before Blender 4.2: drawing all flakes for each lamp doubles the time of a frame."""
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
