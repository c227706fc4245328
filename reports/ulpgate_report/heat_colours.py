"""The colour of an error, the same in the heat map's figure and on the page."""
import matplotlib

from ulpgate_report import numbers

# Half a ULP is what correct rounding gives; above a million the number in the cell says enough.
LOWEST_LOG10_ULP = numbers.log10(0.5)
HIGHEST_LOG10_ULP = 6.0
COLOUR_MAP = "cividis"
INFINITE_COLOUR = "#ffffff"


def position(value):
    """Place of an error on the colour map, 0 to 1; exact results lie at 0."""
    share = numbers.log10(value) - LOWEST_LOG10_ULP
    share /= HIGHEST_LOG10_ULP - LOWEST_LOG10_ULP
    return min(1.0, max(0.0, share))


def background(value):
    """Colour of the cell as #rrggbb."""
    if value == numbers.INFINITE:
        return INFINITE_COLOUR
    return matplotlib.colors.to_hex(matplotlib.colormaps[COLOUR_MAP](position(value)))


def foreground(value):
    """Black or white, whichever can be read on the cell."""
    red, green, blue = matplotlib.colors.to_rgb(background(value))
    luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    return "#000000" if luminance > 0.45 else "#ffffff"
