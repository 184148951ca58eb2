"""The layers of an evaluated rig at the scene's present frame, for operators that write keys."""

from ..core import rigs
from ..core.evaluated import copies
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.wiring import driven_bones
from . import clips, groups, solve


class Moment:
    """All layers of an evaluated rig at the present frame.

    influence: of all layers together; None takes the rig's.
    clips: Clip or None of each layer. acting: indices of the layers with an effect. settings: their rows for the native LayerStack.
    own: own matrices of all bones beneath the layers, (B, 16) float32. places: {name of a bone: its row}.
    """

    def __init__(self, scene, evaluated, influence=None):
        text = groups.plan_of(evaluated, groups.masked(evaluated), driven_bones(evaluated))
        self._wired = rigs.plan(evaluated, text, lambda rig, rows: solve.Wired(rig, rows, text))
        self.source = solve.Source(evaluated, copies.of(evaluated), self._wired)
        self.clips, self.places = self.source.clips(), self._wired.places
        self.frame, self.own = scene_time.present(scene), self.source.reader.own_basis().copy()
        self.source.put_edited(self.clips, self.own, self.frame)
        settings = evaluated.motus.layers
        self.acting, self.settings = solve.acting(settings, self.clips, settings.influence if influence is None else influence)

    def laid(self, count):
        """Return the own matrices of all bones with the lowest `count` layers of the rig over them, (B, 16) float32."""
        rows = [row for row in self.acting if row < count]
        settings = self.settings[: len(rows)]
        found, members = self.own.copy(), self._wired.rows
        laid = np.empty((len(members), 16), np.float32)
        places, turns, sizes = (np.empty((len(members), width)) for width in (3, 4, 3))
        solve.Playing(self.source, self.clips, rows).lay(self.frame, settings, self.own.copy(), places, turns, sizes, laid)
        found[members] = laid
        return found

    def sources(self, base, index, wanted, rows):
        """Return Playing.sources() for the layer of this index. base: as `own`."""
        found = list(self.clips)
        if solve.is_compared(self.source.entries[index]):  # with a pose also of bones that the layer's action does not animate
            found[index] = clips.Told(found[index], rows)
        playing = solve.Playing(self.source, found, self.acting)
        return playing.sources(self.frame, self.settings, base, self.acting.index(index), wanted, rows)

    def bones(self, index):
        """Return {row of a bone: sum of the native module's flags of channels} of what a layer moves."""
        clip = self.clips[index]
        masked = self.source.masks[index]
        return {} if clip is None else {row: flags for row, flags in zip(clip.native.bones, clip.native.channels) if masked[row] > 0.0}
