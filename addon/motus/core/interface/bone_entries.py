"""Lists of settings with an entry for each bone: panels show the active bone's entry, and copy it to selected bones."""

import bpy

from ..declare import entries_on, has_settings, of_owner, registered
from ..refusals import Refused, check_bone
from ..settings import entries
from ..translations import tr
from .view import offering

TO_SELECTED = "motus.to_selected"


def active_property(label, index_of):
    """Declare the IntProperty that holds the index of the shown entry in a list of settings for bones.

    In Pose Mode the entry of the active bone is shown; setting the index makes the bone of that entry the active bone. In different modes,
    and for a bone without an entry, the entry that was chosen last is shown (`chosen_entry`). index_of(settings, name of a bone): index of
    the bone's entry; -1 if it has none.
    """

    def get(settings):
        bone = _active_bone(settings.id_data)
        index = index_of(settings, bone.name) if bone else -1
        # A file may have any number there.
        return min(max(settings.chosen_entry if index < 0 else index, 0), len(settings.entries) - 1)

    def put(settings, index):
        settings.chosen_entry = index
        rig = settings.id_data
        bone = rig.data.bones.get(settings.entries[index].name) if _is_posed(rig) and index < len(settings.entries) else None
        if bone:
            rig.data.bones.active = bone

    return bpy.props.IntProperty(name=label, options={'SKIP_SAVE'}, get=get, set=put)


def _is_posed(obj):
    return obj.type == 'ARMATURE' and obj.mode == 'POSE'


def _active_bone(obj):
    return obj.data.bones.active if _is_posed(obj) else None


def selected(context, name):
    """The entries that an edit of the selection changes, the active one first; an empty list if there is no active entry.

    In Pose Mode these are the entries of the selected bones, otherwise the active entries of the selected objects. name: of the system.
    """
    first = entries.active(context.object, name) if context.object and _uses(context.object, name) else None
    if first is None:
        return []
    if context.mode == 'POSE' and are_of_bones(of_owner(registered[name], first.id_data)):
        found = [_entry_of(bone, name) for bone in context.selected_pose_bones or ()]
    else:
        found = [entries.active(obj, name) for obj in context.selected_objects if _uses(obj, name)]
    return [first, *(entry for entry in found if entry is not None and entry != first)]


def are_of_bones(settings):
    """Whether the entries in a list of settings are of bones, of which the active bone's entry is shown (active_property)."""
    return settings.bl_rna.properties["active_entry"].is_skip_save


def posed(context):
    """Names of the selected bones of the active rig, the active bone first if it is selected; empty if not in Pose Mode."""
    rig = context.object
    if rig is None or not _is_posed(rig):
        return []
    names = [bone.name for bone in context.selected_pose_bones or () if bone.id_data == rig]
    active = rig.data.bones.active
    return sorted(names, key=lambda name: active is None or name != active.name)


def names_in(rig, text):
    """List of the bone names in a comma-separated text, without repetitions. Raises Refused if the rig has no bone of a name."""
    found = [name.strip() for name in text.split(",") if name.strip()]
    for name in found:
        check_bone(rig, name)
    return list(dict.fromkeys(found))


def check_apart(found):
    """Raise Refused if two entries would drive one bone. found: {bone of the entry: names of the bones that it drives}."""
    taken = {}
    for entry, bones in found.items():
        for name in bones:
            if name in taken:
                raise Refused(
                    tr("{bone} would be driven from {first} and from {second}").format(bone=name, first=taken[name], second=entry)
                )
            taken[name] = entry


def check_free(rig, names, system):
    """Raise Refused if a system other than `system` drives one of a rig's bones, and keeps it (Entry.keeps). names: of the bones."""
    for other, entry in entries_on(rig):
        shared = set(names) & {one for one in entry.keeps if isinstance(one, str)}
        if shared and other != system:
            raise Refused(
                tr("{bone} is driven by {system} of {other} already").format(bone=min(shared), system=tr(other.label), other=entry.name)
            )


def has_entry(rig, name, bone):
    """Whether a system has an entry for a bone of a rig. name: of the system. bone: name of the bone."""
    return _uses(rig, name) and bone in of_owner(registered[name], rig).entries


def draw_add(layout, identifier, icon, words, bones=(), idle=""):
    """Draw a button that adds a system, with a text that says to what; returns the button's properties.

    words: the text, in the user's language; if it is empty the button is greyed out. idle: the text of the greyed button, in the user's
    language; if it is empty too the button has the operator's label. identifier: of the operator. bones: names of the bones that the
    operator works on; if empty, it works on the selection.
    """
    row = layout.row(align=True)
    row.enabled = bool(words)
    row.operator_context = 'INVOKE_DEFAULT'
    text = words or idle
    button = row.operator(identifier, icon=icon, **({"text": text, "translate": False} if text else {}))
    if bones:
        button.bones = ",".join(bones)
    return button


def _uses(obj, name):
    return has_settings(registered[name], obj)  # reading Object.motus creates the property group on the object


def _entry_of(bone, name):
    rig = bone.id_data
    return of_owner(registered[name], rig).entries.get(bone.name) if _uses(rig, name) else None


def draw_shown(layout, system, label, icon='BONE_DATA'):
    """Draw the name of the bone whose settings are drawn below, and the button *To All Selected*. system: name of the system."""
    row = offering.offer(layout.row(align=True))
    row.label(text=label, icon=icon, translate=False)
    row.operator(TO_SELECTED).system = system.name
