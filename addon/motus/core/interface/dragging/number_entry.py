"""A number that is typed while an operator runs."""

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
    """Text that grows key by key.

    takes_numpad: whether a number may begin on the numeric keypad, which otherwise turns the view.
    """

    def __init__(self, takes_numpad=False):
        self.text = ""
        self._takes_numpad = takes_numpad

    @property
    def is_open(self):
        """Whether something has been typed."""
        return bool(self.text)

    @property
    def value(self):
        """The number, or None where the text is none yet."""
        try:
            return float(self.text)
        except ValueError:
            return None

    def key(self, kind):
        """Take the key of that type; False where it has nothing to do with the number."""
        if kind == 'BACK_SPACE' and self.is_open:
            self.text = self.text[:-1]
            return True
        if kind in MINUS and (self.is_open or self._takes_numpad or kind == 'MINUS'):
            # As in Blender's own fields, wherever it is typed.
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
        """Forget what was typed."""
        self.text = ""
