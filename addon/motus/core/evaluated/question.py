"""What is found while one question about tracks is answered, such as for the values of one.

Things that hang on each other, each moved by a system that is asked where it is, lead to the same ones again and again: without
this each level would take several times as long as the one above it.
"""

from .. import keeping

answered = keeping.WhileAnswering(
    "what things that hang on each other answer about their motion", "the thing, and all that the answer depends on"
).answered
"""answered(place, make): what make() gives, the same for the same place until the outermost question is answered."""
