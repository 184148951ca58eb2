"""Units, axes, frames and seconds, tests for finite numbers and for mirroring, and limits for the work of solvers."""
