"""The numbers that a figure shows, read back from what was drawn: nothing plotted can be missing or be another."""
import numpy

COLUMNS = ("panel", "kind", "series", "index", "x", "y", "value")


def _text(number):
    """Shortest text that reads as the same double; empty for what is masked or no number."""
    if number is None or number is numpy.ma.masked:
        return ""
    try:
        value = float(number)
    except (TypeError, ValueError):
        return str(number)
    return "" if value != value else repr(value)


def _label(artist):
    label = str(artist.get_label() or "")
    # Matplotlib's own names of what has none.
    return "" if label.startswith("_") else label


def _lines(axes):
    for line in axes.get_lines():
        xs, ys = line.get_data(orig=False)
        for index, (x, y) in enumerate(zip(numpy.ravel(xs), numpy.ravel(ys))):
            yield "line", _label(line), index, x, y, None


def _collections(axes):
    for collection in axes.collections:
        label, kind = _label(collection), type(collection).__name__
        values = collection.get_array()
        values = None if values is None else numpy.ma.ravel(values)
        if kind in ("PathCollection", "EllipseCollection"):
            for index, (x, y) in enumerate(numpy.ma.getdata(collection.get_offsets())):
                one = values is not None and index < len(values)
                yield "points", label, index, x, y, values[index] if one else None
        elif kind in ("QuadMesh", "AxesImage"):
            for index, value in enumerate(values):
                yield "grid", label, index, None, None, value
        elif kind == "LineCollection":
            for index, segment in enumerate(collection.get_segments()):
                for x, y in segment:
                    yield "segments", label, index, x, y, None
        else:
            for index, path in enumerate(collection.get_paths()):
                for x, y in path.vertices:
                    yield "area", label, index, x, y, None


def _patches(axes):
    for index, patch in enumerate(axes.patches):
        if hasattr(patch, "get_width") and hasattr(patch, "get_x"):
            x = patch.get_x() + patch.get_width() / 2
            y = patch.get_y() + patch.get_height()
            yield "bar", _label(patch), index, x, y, patch.get_height()
        elif hasattr(patch, "get_radius"):
            x, y = patch.center
            yield "circle", _label(patch), index, x, y, patch.get_radius()


def _images(axes):
    for image in axes.get_images():
        for index, value in enumerate(numpy.ma.ravel(image.get_array())):
            yield "grid", _label(image), index, None, None, value


def _texts(axes):
    for index, text in enumerate(axes.texts):
        x, y = text.get_position()
        words = " ".join(text.get_text().split())
        if words:
            yield "text", words, index, x, y, None


def _words(axes):
    """Everything written at the edges of a panel: ticks, titles, legends; ticks are those of the last drawing."""
    ticks = [*axes.get_xticklabels(which="both"), *axes.get_yticklabels(which="both")]
    written = [("tick", t.get_text()) for t in ticks]
    written += [("label", axes.get_xlabel()), ("label", axes.get_ylabel())]
    written.append(("label", axes.xaxis.get_offset_text().get_text()))
    written.append(("label", axes.yaxis.get_offset_text().get_text()))
    written.append(("label", axes.get_title(loc="left")))
    if axes.get_legend() is not None:
        written += [("legend", t.get_text()) for t in axes.get_legend().get_texts()]
    for index, (kind, text) in enumerate(written):
        words = " ".join(text.split())
        if words:
            yield kind, words, index, None, None, None


def _of_figure(figure):
    texts = [("text", t.get_text()) for t in figure.texts]
    for legend in figure.legends:
        texts += [("legend", t.get_text()) for t in legend.get_texts()]
    return [
        ("", kind, " ".join(text.split()), str(i), "", "", "")
        for i, (kind, text) in enumerate(texts)
    ]


def of(figure):
    """Rows of COLUMNS, all text: every line, point, bar, cell and written word of each panel, in the order drawn.

    The figure was rendered before: ticks get their labels then.
    """
    rows = _of_figure(figure)
    for number, axes in enumerate(figure.axes):
        panel = " ".join(axes.get_title().split()) or str(number)
        for read in (_lines, _collections, _patches, _images, _texts, _words):
            for kind, series, index, x, y, value in read(axes):
                rows.append(
                    (panel, kind, series, str(index), _text(x), _text(y), _text(value))
                )
    return rows
