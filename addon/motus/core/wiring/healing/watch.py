"""Collect what solvers and handlers detect between two repairs (see repairs.py), by names, until the evaluation has ended.

Solvers run in Blender's evaluation threads and must not change the file, so they only store names here. All names are those of local
datablocks: linked objects are wired in their own file.

The owner is the object whose settings a system solves. A hub is a hidden object whose mesh carries the driver and results of a solver;
several owners can share one, with a row each. Drivers of properties are at rest if they are muted and drive a placeholder custom
property, as they are saved in a file.
"""

import bpy

from ..hubs.rows import names_in
from ..sinks import property_sink


class Noticed:
    """Everything that solvers and handlers have detected since the file was opened.

    A *place* is the pair (name of a system, name of an owner).
    """

    def __init__(self):
        self.evaluations = 0
        """Number of evaluations that have ended since a solver was first called. It never decreases, even if a different file is opened."""
        self.reset()

    def reset(self):
        """Discard everything that was detected except the number of evaluations. Called when a different file was opened."""
        self.in_use = False
        """Whether any solver was called since the file was opened; solvers set it. Until then most kinds of repairs are not looked for."""
        self.object_count = -1
        """Number of objects in the file when copies were last looked for; -1 if they have to be looked for in any case."""
        self.states = {}
        """(name of a system, name of an owner) -> state of the owner that note_state() was last called with."""
        self.changed = set()
        """(name of a system, name of an owner) of the owners whose state has changed and that may have to be wired again."""
        self.orphans = set()
        """Names of the hubs' meshes whose owner was removed."""
        self.bone_counts = {}
        """(name of an armature, name of its library or None) -> number of its bones when the rigs with the armature were last examined."""
        self.bones = {}
        """(name of an armature, name of its library or None) -> hash of its bones when the owners with the armature were last looked at."""
        self.moved_points = set()
        """(name of a system, name of an owner) of the owners whose solver reads their mesh."""
        self.gathering = set()
        """(name of a system, name of an owner) of the owners whose solvers read objects of a collection."""
        self.rows = {}
        """(name of a system, name of the mesh of a hub that several owners share) -> list of the rows of the hub."""
        self.holders = {}
        """Key of `rows` -> (list of the rows, what holders_of() has found for the list)."""
        self.unsettled = set()
        """(name of a system, name of an owner) of the owners for which System.settle is to be called after the evaluation."""
        self.resting = set()
        """(name, name of the library or None) of the hubs' meshes whose drivers of properties are at rest (muted)."""
        self.given_up = set()
        """(name of a system, name of an owner) of the copied owners that could not get hubs of their own; Motus tries only once."""

    def note_state(self, place, state):
        """Store the state of an owner; if it differs from the state stored before, add the owner to `changed`.

        place: (name of the system, name of the owner). state: (number of the owner's drivers, whether relevant settings are animated). The
        owner's solver calls this method; for owners that share a solver, a repair calls this method instead, after the evaluation.
        """
        if self.states.get(place) != state:
            self.states[place] = state
            self.changed.add(place)

    def note_properties(self, hub):
        """Add a hub to `resting` if the drivers that bring its results to properties are at rest, as in a saved file.

        At rest, the drivers are muted, and each drives a placeholder custom property instead of its own property. A handler switches them
        on after the evaluation. hub: evaluated mesh of the hub, whose solver calls this method.
        """
        if property_sink.is_resting(hub):
            self.resting.add(key(hub))

    def note_rows(self, system, name, rows):
        """Store the rows of a hub that several owners share, so that repairs can look at these owners after the evaluation.

        The hub's solver calls this method. system: the System. name: name of the hub's mesh. rows: for each row its Row, None if no owner
        has the row, or the class Damaged.
        """
        self.rows[system.name, name] = rows

    def holders_of(self, hub, rows):
        """Return (place, local object of the place's name or None) for each owner that has one of these rows of a shared hub.

        hub: key of the hub in `rows`. The names are looked up once for each list of rows, since Blender finds an object by going through
        all objects of the file.
        """
        known = self.holders.get(hub)
        if known is None or known[0] is not rows:
            local = {obj.name: obj for obj in bpy.data.objects if not obj.library}
            known = self.holders[hub] = rows, [((hub[0], name), local.get(name)) for name in names_in(rows)]
        return known[1]

    def note_orphan(self, hub):
        """Store that a hub's owner was deleted, and have copies of that owner looked for, since they may still use the hub.

        hub: evaluated mesh of the hub.
        """
        if hub.name not in self.orphans:
            self.orphans.add(hub.name)
            self.object_count = -1

    def note_unsettled(self, system, owner):
        """Have System.settle called with an owner after the evaluation. Solvers call this method with the evaluated owner."""
        if not owner.library:
            self.unsettled.add((system.name, owner.name))


noticed = Noticed()
"""Everything that was detected in the open file."""


def evaluation():
    """Return a number that all solvers of one evaluation get, and that differs in the next evaluation of the viewport."""
    return noticed.evaluations


def key(datablock):
    """Return (name, name of the library or None), which identifies a datablock among all datablocks of its type."""
    return datablock.name, datablock.library and datablock.library.name
