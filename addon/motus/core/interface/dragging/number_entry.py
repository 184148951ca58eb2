"""Entry of a number that the user types while a modal operator runs."""

DIGITS = {
    'ZERO': "0",
    'ONE': "1",
    'TWO': "2",
    'THREE': "3",
    'FOUR': "4",
    'FIVE': "5",
    'SIX': "6",
    'SEVEN': "7",
    'EIGHT': "8",
    'NINE': "9",
    'PERIOD': ".",
    'COMMA': ".",
}
NUMPAD = {f'NUMPAD_{digit}': str(digit) for digit in range(10)} | {'NUMPAD_PERIOD': ".", 'NUMPAD_COMMA': "."}
MINUS = {'MINUS', 'NUMPAD_MINUS'}
CONFIRMING = {'RET', 'NUMPAD_ENTER'}


class NumberEntry:
    """Text of a number that the user types key by key.

    takes_numpad: whether a number may begin with a key of the numeric keypad, whose keys otherwise turn the view.
    """

    def __init__(self, takes_numpad=False):
        self.text = ""
        self._takes_numpad = takes_numpad

    @property
    def is_open(self):
        """Whether the user has typed anything."""
        return bool(self.text)

    @property
    def value(self):
        """The typed number; None if the text is not a number yet."""
        try:
            return float(self.text)
        except ValueError:
            return None

    def key(self, kind):
        """Change the text by a pressed key: a digit, a point, a minus or Backspace. Returns False if the key is not for the number.

        kind: Event.type of the key.
        """
        if kind == 'BACK_SPACE' and self.is_open:
            self.text = self.text[:-1]
            return True
        if kind in MINUS and (self.is_open or self._takes_numpad or kind == 'MINUS'):
            # A minus changes the sign at any position in the text, like in Blender's own fields.
            self.text = self.text[1:] if self.text.startswith("-") else "-" + self.text
            return True
        character = DIGITS.get(kind)
        if character is None and (self._takes_numpad or self.is_open):
            character = NUMPAD.get(kind)
        if character is None:
            return False
        if character != "." or "." not in self.text:
            self.text += character
        return True

    def clear(self):
        """Delete the typed text."""
        self.text = ""
