"""Answers that are kept while one question about a track is being answered, such as a question for its values.

The motion of an object may depend on objects that systems of Motus drive, and these may all depend on the same parents. Without kept
answers each level of such a hierarchy would take several times as long as the level above it.
"""

from .. import keeping

answered = keeping.WhileAnswering(
    "answers about the motion of objects and bones that depend on each other", "object or bone, and all inputs of the answer"
).answered
"""answered(place, make): the result of make(), kept under the hashable `place` until the outermost question is answered."""
