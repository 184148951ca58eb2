"""Panel and operators for tracks, the motions of objects, bones or properties over time: how they are known, recording."""
