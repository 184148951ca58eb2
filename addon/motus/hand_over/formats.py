"""Files for other programs, by Blender's own exporters, from what has become plain Blender."""

from typing import Any, NamedTuple

import bpy

from ..core.refusals import Refused
from ..core.translations import tr
from . import exchange


class Format(NamedTuple):
    """A format of files. operator: Blender's, as in bpy.ops. keywords: for the operator; those that a version of Blender lacks are left out.

    points: what the file has of flakes, as exchange.Shown shows them.
    """

    label: str
    description: str
    suffix: str
    operator: str
    keywords: dict[str, Any]
    points: str = exchange.NOTHING


FORMATS = {
    'GLTF': Format(
        "glTF",
        "Rigs and objects for engines and the web, in a .glb file: axes with Y up, and one animation for all",
        ".glb",
        "export_scene.gltf",
        {
            "export_format": 'GLB',
            "export_animations": True,
            "export_animation_mode": 'ACTIVE_ACTIONS',
            "export_nla_strips": False,  # the same before Blender 3.6
            "export_frame_range": True,
            "export_force_sampling": True,
            "export_optimize_animation_size": False,
        },
    ),
    'USD': Format(
        "USD",
        "Everything as Universal Scene Description, in a .usdc file: transforms, skeletons and meshes of each frame",
        ".usdc",
        "wm.usd_export",
        {"export_animation": True, "export_armatures": True, "only_deform_bones": False, "evaluation_mode": 'RENDER'},
        exchange.CLOUDS,
    ),
    'ALEMBIC': Format(
        "Alembic",
        "Transforms and the vertices of each frame, in a .abc file",
        ".abc",
        "wm.alembic_export",
        {"as_background_job": False, "evaluation_mode": 'RENDER'},
        exchange.MESHES,
    ),
    'FBX': Format(
        "FBX",
        "Rigs and objects for programs that read FBX, in a .fbx file",
        ".fbx",
        "export_scene.fbx",
        {
            "bake_anim": True,
            "bake_anim_use_all_actions": False,
            "bake_anim_use_nla_strips": False,
            "bake_anim_simplify_factor": 0.0,
            "add_leaf_bones": False,
        },
    ),
}
ITEMS = tuple((name, one.label, one.description, 1 << index) for index, (name, one) in enumerate(FORMATS.items()))


def check(names):
    """Raise Refused if this Blender lacks the exporter of one of the formats. names: keys of FORMATS."""
    for name in sorted(names):
        try:
            _operator(FORMATS[name]).get_rna_type()
        except (AttributeError, KeyError):
            raise Refused(tr("This Blender has no exporter for {format}").format(format=FORMATS[name].label)) from None


def need_velocities(names):
    """Whether one of the formats has the velocities of points. names: keys of FORMATS."""
    return any(FORMATS[name].points == exchange.CLOUDS for name in names)


def export(shown, scene, names, path_of, span):
    """Write the open file in these formats. shown: exchange.Shown. path_of: function of a suffix that returns a path. span: (first, last) frame."""
    scene.frame_start, scene.frame_end = span
    for name in sorted(names):
        found = FORMATS[name]
        shown.show(found.points)
        operator = _operator(found)
        known = operator.get_rna_type().properties.keys()
        keywords = {"filepath": str(path_of(found.suffix)), "start": span[0], "end": span[1]} | found.keywords
        operator(**{keyword: value for keyword, value in keywords.items() if keyword in known})


def _operator(one):
    group, _, name = one.operator.partition(".")
    return getattr(getattr(bpy.ops, group), name)
