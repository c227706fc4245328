"""Tests of the layout of tables: all of a table is on its page, whatever its columns hold."""
import pytest

from ulpgate_report.paper import fragments, layout, provenance
from ulpgate_report.tables.table import Column, Table, columns_of


def _table(rows, *columns):
    return Table("t", "A caption.", tuple(columns), tuple(rows))


def _numbers(count, rows):
    columns = columns_of("count", **{f"c{i}": f"column {i}" for i in range(count)})
    return Table("t", "A caption.", columns, ((12345678,) * count,) * rows)


PROSE = Column("why", "why", "prose")
CODE = Column("case", "case", "code")
COMMAND = Column("command", "command", "command")


def test_a_narrow_table_stands_as_it_is():
    text, shown, sideways = layout.laid_out(_table([("x",)], CODE))
    assert not sideways and shown.columns == (CODE,)


def test_the_page_is_turned_for_many_rows_and_the_table_for_few():
    many, _, sideways = layout.laid_out(_numbers(18, 20))
    assert sideways and many.count("&") == 17 * 22
    few, _, sideways = layout.laid_out(_numbers(18, 2))
    assert not sideways and r"{@{}lrr@{}}" in few
    assert few.count(r"\num{12345678}") == 36


def test_commands_go_before_the_page_is_turned():
    rows = [("c" * 60, "words " * 30, "ulpgate stress --cases " + "c" * 40)] * 3
    text, shown, sideways = layout.laid_out(_table(rows, CODE, PROSE, COMMAND))
    assert not sideways and shown.columns == (CODE, PROSE)
    assert "The commands are in the CSV file." in shown.caption


@pytest.mark.parametrize("words", [1, 10, 200])
def test_columns_of_prose_fill_the_page_and_no_more(words):
    found = _table([("c" * 40, "of the type", "word " * words)] * 4, CODE, PROSE, PROSE)
    widths = layout.prose_widths(found, layout.TEXT_WIDTH_MM)
    fixed = 40 * 1.32 + 2.2 * 3
    assert len(widths) == 2 and sum(widths) + fixed <= layout.TEXT_WIDTH_MM + 0.1
    if words == 200:
        # The short one has what it wants, the long one the rest.
        assert widths[0] < 30 and widths[1] > 60


def test_columns_without_anything_are_left_out():
    found = _table([("x", None), ("y", None)], CODE, COMMAND)
    assert layout.laid_out(found)[1].columns == (CODE,)


def test_a_table_goes_on_with_its_name_and_its_ends_stay_together():
    text = fragments.table(_numbers(3, 9))
    assert (
        r"\multicolumn{3}{@{}l}{\footnotesize\bfseries Table \thetable, continued}"
        in text
    )
    rows = [line for line in text.splitlines() if r"\num{12345678}" in line]
    assert [line.endswith("*") for line in rows] == [True] * 3 + [False] * 3 + [
        True,
        True,
        False,
    ]


def test_a_command_breaks_between_its_words():
    text = fragments.tex_command(
        "ulpgate math --types float,double,long_double,float128"
    )
    assert text.count(" ") == 3 and r"long\char95{}double" in text
    assert r"\allowbreak{}" in text, "a list has no other place to break"


def test_no_room_for_prose_is_said():
    found = _table([("c" * 130, "word " * 50)], CODE, PROSE)
    assert layout.prose_widths(found, layout.TEXT_WIDTH_MM) is None


def test_what_is_too_long_is_shortened_and_says_so():
    text = fragments.table(_numbers(3, 500))
    assert text.count(r"\num{12345678}") == 3 * layout.MOST_LINES
    assert "The first 420 of 500 rows" in text
    prose = _table([("word " * 70,)] * 200, PROSE)
    assert "The first 84 of 200 rows" in fragments.table(prose)


def test_powers_and_symbols_of_a_caption_are_set_as_such():
    said = fragments.caption(
        "errors below 2^-6, u = 2^-p, 2^-(p-1), C dt^p; t_s in `a_b 2^3`"
    )
    for shown in ("2}^{-6}$", "2}^{-p}$", "2}^{-(p-1)}$", "dt}^{p}$", "$t_s$"):
        assert shown in said
    assert "textasciicircum" in said, "a command stays what is typed"


COMMANDS = {
    "pendulum/dt_1e-5": "ulpgate scene correlate --dt 1e-5",
    "pendulum/dt_1e-5_yade": "ulpgate scene correlate --dt 1e-5 --set mass=yade",
    "pendulum/damped": "ulpgate scene run --set damping=5e-3",
    "pendulum/orders": "ulpgate integrators",
    "pendulum": "the first and 3 more",
}


@pytest.mark.parametrize(
    "name, run",
    [
        ("pendulum_correlation_pendulum3_dt_1e-5", "pendulum/dt_1e-5"),
        ("pendulum_correlation_pendulum3_dt_1e-5_yade", "pendulum/dt_1e-5_yade"),
        ("pendulum_t_s_pendulum3_mass-yade", "pendulum/dt_1e-5_yade"),
        ("pendulum_max_error_pendulum3_damping-5e-3", "pendulum/damped"),
        ("pendulum_orders_kepler", "pendulum/orders"),
        ("order_table", "pendulum/orders"),
        ("pendulum_divergence", "pendulum"),
    ],
)
def test_a_figure_has_the_command_of_its_own_run(name, run):
    assert provenance.command_of(COMMANDS, "pendulum", name) == COMMANDS[run]
