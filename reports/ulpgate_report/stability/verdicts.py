"""The verdicts: letter, words and colours of each, the same in figures and on the page."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Verdict:
    """One verdict; the colours are #rrggbb, the front one is read on the back one."""

    name: str
    letter: str
    words: str
    back: str
    front: str


# Pale where a type does what the problem allows, strong where not. Blue, orange, vermilion and greys are told apart by
# colour-blind readers too (Okabe and Ito), and no cell is without its letter.
ALL = (
    Verdict("stable", "S", "stable", "#d6eaf8", "#1b1b1b"),
    Verdict("ill_conditioned", "I", "ill-conditioned", "#7cc0ee", "#000000"),
    Verdict("unstable", "U", "unstable", "#f0b429", "#000000"),
    Verdict("wrong_outcome", "W", "wrong outcome", "#d55e00", "#000000"),
    Verdict("diverged", "D", "diverged", "#3a3a3a", "#ffffff"),
    Verdict("refused", "R", "refused", "#c8c8c8", "#000000"),
)
BY_NAME = {verdict.name: verdict for verdict in ALL}
BY_LETTER = {verdict.letter: verdict for verdict in ALL}
GOOD = ("stable", "ill_conditioned")
LEGEND = ", ".join(f"{verdict.letter} {verdict.words}" for verdict in ALL)


class Scale:
    """The colours of letters, as the page asks a heat map for them."""

    @staticmethod
    def background(letter):
        """Colour of a cell."""
        return BY_LETTER[letter].back

    @staticmethod
    def foreground(letter):
        """Colour of its letter."""
        return BY_LETTER[letter].front
