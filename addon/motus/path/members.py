"""Who follows: the owner of the settings and its wagons, and what of them is driven."""


def channels(settings):
    """What is driven; without an orientation the object keeps its own rotation."""
    return frozenset({"location"} if settings.orientation == 'NONE' else {"location", "rotation"})


def members(owner):
    """The owner, then the wagons that exist."""
    return [owner] + [wagon.object for wagon in owner.motus.path.wagons if wagon.object]


def index_of(leader, wagon):
    """Index of an object in its leader's list of wagons, or -1."""
    return next((i for i, entry in enumerate(leader.motus.path.wagons) if entry.object == wagon), -1)


def take_out(leader, index):
    """Remove an entry from the list of wagons; those behind keep their places."""
    wagons = leader.motus.path.wagons
    if index + 1 < len(wagons):
        wagons[index + 1].gap += wagons[index].gap
    wagons.remove(index)
