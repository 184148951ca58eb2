"""What is known of evaluated datablocks, of each of them for as long as it is there."""

import threading


class Latest:
    """What is known of evaluated datablocks, of each of them for as long as it is there and was not copied anew.

    Blender copies a datablock anew to where it lay before.
    """

    FEW = 64
    """Up to so many are kept without a look at which of them are gone."""

    def __init__(self):
        self.known = {}  # number -> what is known of the copy that has it
        self._places = {}  # where a datablock lies -> (it, the number)
        self._most = self.FEW
        self._changing = threading.Lock()

    def add(self, evaluated, number, found):
        """Let this be known of a copy, in the place of what was known of the one before; gives it."""
        place = evaluated.as_pointer()
        with self._changing:
            self._forget(place)
            self._places[place] = evaluated, number
            self.known[number] = found
            if len(self._places) > self._most:
                for gone in [place for place, (datablock, _) in self._places.items() if is_gone(datablock)]:
                    self._forget(gone)
                self._most = 2 * max(len(self._places), self.FEW)
        return found

    def _forget(self, place):
        _, number = self._places.pop(place, (None, 0))
        self.known.pop(number, None)

    def clear(self):
        """Let nothing be known."""
        with self._changing:
            self._places.clear()
            self.known.clear()
            self._most = self.FEW


def is_gone(datablock):
    """Whether Blender has freed an evaluated datablock."""
    try:
        datablock.as_pointer()
    except ReferenceError:
        return True
    return False
