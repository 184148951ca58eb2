"""Grounds that several demo scenes stand on: the land round a lake, its woods, a colonnade, and a studio for clay."""
