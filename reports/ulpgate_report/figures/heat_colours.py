"""The colour of an error, the same in a heat map's figure and on the page."""
from dataclasses import dataclass

import matplotlib

from ulpgate_report.values import numbers

COLOUR_MAP = "cividis"
INFINITE_COLOUR = "#ffffff"


@dataclass(frozen=True)
class Scale:
    """A logarithmic scale of colours; beyond its ends the colour stays."""

    lowest_log10: float
    highest_log10: float

    def position(self, value):
        """Place of an error on the colour map, 0 to 1; exact results lie at 0."""
        share = numbers.log10(value) - self.lowest_log10
        share /= self.highest_log10 - self.lowest_log10
        return min(1.0, max(0.0, share))

    def background(self, value):
        """Colour of the cell as #rrggbb."""
        if value == numbers.INFINITE:
            return INFINITE_COLOUR
        colours = matplotlib.colormaps[COLOUR_MAP]
        return matplotlib.colors.to_hex(colours(self.position(value)))

    def foreground(self, value):
        """Black or white, whichever can be read on the cell."""
        red, green, blue = matplotlib.colors.to_rgb(self.background(value))
        luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue
        return "#000000" if luminance > 0.45 else "#ffffff"


# Half a ULP is what correct rounding gives; above a million the number in the cell says enough.
ULP = Scale(numbers.log10(0.5), 6.0)
# Roundings beyond the condition: a stable kernel has less than 16, a hundred is unstable whatever it is.
ROUNDINGS = Scale(numbers.log10(0.5), 2.0)
