"""Check chains over a range of frames: find the frames on which they do not reach their targets."""
