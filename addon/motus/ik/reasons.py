"""Negative values of the solver's output "reason", for chains that are not solved. Values from 0 on are those of native.Reason."""

NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE, MUTED = -1.0, -2.0, -3.0, -4.0, -5.0
UNWANTED = (NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE)
