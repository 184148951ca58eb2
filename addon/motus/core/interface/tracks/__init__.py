"""The panel that says how an input over time is known, and the operators that record it."""
