"""What solvers and handlers notice between two repairs (see repairs.py), kept by names until the evaluation has ended.

Solvers run in threads of Blender's and must change nothing, so they leave names here. All names are of local datablocks: what is
linked is wired in its own file.
"""

from ..sinks import property_sink


class Noticed:
    """Everything that was noticed since the file was opened. A *place* is (name of a system, name of an owner)."""

    def __init__(self):
        self.evaluations = 0
        """How many evaluations have ended since a solver was first called: no number comes twice, whatever file is opened."""
        self.reset()

    def reset(self):
        """Discard all that was noticed, since a different file is open."""
        self.in_use = False
        """Whether any solver was called. Until then nothing of Motus in the file can need a repair."""
        self.object_count = -1
        """How many objects the file had when copies were last looked for; -1 if they are to be looked for in any case."""
        self.states = {}
        """Place -> the last state that note_state() was told."""
        self.changed = set()
        """Places whose state has changed."""
        self.orphans = set()
        """Names of the meshes of hubs whose owner is gone."""
        self.bone_counts = {}
        """Key of an armature -> how many bones it had when the rigs with it were last looked at."""
        self.moved_points = set()
        """Places whose points are moved by their system."""
        self.gathering = set()
        """Places whose solvers read what a collection holds."""
        self.rows = {}
        """(name of a system, name of the mesh of a hub that owners share) -> the rows of that hub."""
        self.unsettled = set()
        """Places that have asked for System.settle after the evaluation."""
        self.resting = set()
        """Keys of the meshes of hubs whose drivers of properties are at rest."""
        self.given_up = set()
        """Places that could not be given hubs of their own, which is tried once."""

    def note_use(self):
        """Called by every solver."""
        self.in_use = True

    def note_state(self, place, state):
        """Compare the state of an owner with the last one noted; mark the owner as changed if they differ.

        place: (name of the system, name of the owner). state: (number of the owner's drivers, whether relevant settings are animated).
        Solvers call it; if several owners share one solver, it is called after the evaluation.
        """
        if self.states.get(place) != state:
            self.states[place] = state
            self.changed.add(place)

    def note_properties(self, hub):
        """Called by the solver with an evaluated hub's mesh that drives properties."""
        if property_sink.is_resting(hub):
            self.resting.add(key(hub))

    def note_rows(self, system, name, rows):
        """Called by the solver of a hub that owners share, with the name of the hub's mesh and its rows."""
        self.rows[system.name, name] = rows

    def note_orphan(self, hub):
        """Note a hub whose owner was deleted; copies of that owner may still depend on the hub. hub: evaluated mesh of the hub."""
        if hub.name not in self.orphans:
            self.orphans.add(hub.name)
            self.object_count = -1

    def note_unsettled(self, system, owner):
        """Request that System.settle is called with the original of an evaluated owner after the evaluation. Solvers call it."""
        if not owner.library:
            self.unsettled.add((system.name, owner.name))


noticed = Noticed()
"""What was noticed in the file that is open."""


def evaluation():
    """A number that is the same for all solvers of one evaluation, and a different one for the next in the viewport."""
    return noticed.evaluations


def key(datablock):
    """What tells a datablock from others of its kind: its name, and the name of its library."""
    return datablock.name, datablock.library and datablock.library.name
