"""What a library override may not do with the data that it has from its library."""


def count_from_library(owner, path):
    """How many items of a list of the owner, the first ones, are its library's, which Blender does not let it remove."""
    reference = owner.override_library and owner.override_library.reference
    if not reference:
        return 0
    try:
        return len(reference.path_resolve(path))
    except ValueError:  # the library has no such list, as with the list of an item that was added
        return 0
