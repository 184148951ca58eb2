"""Takes back what was registered, whatever other scripts have taken away before."""

import logging

log = logging.getLogger(__name__)


def run(*steps):
    """Call each step. One that fails because its thing is gone already does not keep the others from being called."""
    for step in steps:
        try:
            step()
        except Exception as error:
            # Blender says that something is gone by errors of every kind, plain Exception among them.
            log.warning("Motus: something was gone already when the add-on was disabled: %s", error)
