"""Set up a system on an owner, set it up again after changes, and remove it: hubs, drivers of solvers, and the order of evaluation."""
