"""Animation layers: actions that are laid over a rig's own animation, each on the bones of a mask and with a weight that can be keyed."""

from ..core.declare import System
from . import flattening, groups, keying, list_operators, merging, operators, over_time, overlay, panel, presets, properties, solve

SYSTEM = System(
    name="layers",
    label="Animation Layers",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_layers,
    classes=(
        # Blender has to know a property group before the property group that contains it is registered.
        properties.MOTUS_PG_layers_mask,
        properties.MOTUS_PG_layers_entry,
        properties.MOTUS_PG_layers,
        *operators.classes,
        *list_operators.classes,
        *flattening.classes,
        *keying.classes,
        *merging.classes,
        *presets.classes,
        *panel.classes,
    ),
    owner_types=frozenset({'ARMATURE'}),
    solve=solve.solve,
    copied_settings=properties.KEYWORDS,
    shot_settings=frozenset(properties.KEYWORDS) - set(presets.OF_A_STYLE),
    problems=solve.PROBLEMS,
    reads_keys=True,
    lays_pose=True,
    members=groups.members,
    groups=groups.groups,
    entries=groups.entries,
    bone_renamed=groups.bone_renamed,
    over_time=over_time.over_time,
    overlay=overlay.overlay,
    object_menu=("motus.layer_add", "motus.layer_remove", "motus.layers_flatten"),
    pose_menu=("motus.layer_add", "motus.layer_key", "motus.layer_mask_add", "motus.layer_remove", "motus.layers_flatten"),
)
