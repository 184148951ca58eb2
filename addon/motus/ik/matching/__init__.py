"""Match targets and poles of chains to the animated pose, or the animated pose to the solution, over a range of frames."""
