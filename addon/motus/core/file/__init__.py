"""Checks of data from a file, which may hold anything in place of the data that Motus stores."""
