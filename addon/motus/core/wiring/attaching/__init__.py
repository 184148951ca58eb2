"""Wires a system on an owner, wires it anew, and takes it back: hubs, solver drivers, and the order of evaluation."""
