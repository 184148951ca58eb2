"""What a file of somebody else's may hold in the place of what Motus keeps in it."""
