"""Values of the output "reason" beside native.Reason's own."""

NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE, MUTED = -1.0, -2.0, -3.0, -4.0, -5.0
UNWANTED = (NOT_FINITE, NO_TARGET, TARGET_DELETED, NO_TARGET_BONE)
