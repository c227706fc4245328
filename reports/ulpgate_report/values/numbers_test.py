"""Tests of the numbers' short texts: tables of input, expected and why."""
import pytest

from ulpgate_report.values import numbers

INF = numbers.INFINITE


@pytest.mark.parametrize(
    "value, expected, why",
    [
        (None, "-", "nothing judged"),
        ("inf", "inf", "infinite"),
        (0, "0", "exact"),
        (0.5, "0.500", "three decimals below 1"),
        (0.99951, "1.00", "rounds up to the next form"),
        (9.996, "10.0", "likewise"),
        (99.96, "100", "likewise"),
        (9999.4, "9999", "whole up to four digits"),
        (9999.6, "1.00e4", "then an exponent"),
        (5.3e4, "5.30e4", "three digits"),
        (0.0005, "5.00e-4", "small"),
        (1e300, "1.00e300", "near the end of double"),
        (10**400, "1.00e400", "an integer beyond double"),
        (9996 * 10**396, "1.00e400", "whose mantissa rounds up to 10"),
    ],
)
def test_short_ulp(value, expected, why):
    assert numbers.short_ulp(numbers.measured(value)) == expected, why


@pytest.mark.parametrize(
    "value, expected, why",
    [
        (None, "-", "nothing judged"),
        (INF, "inf", "infinite"),
        (7, "7", "whole"),
        (7.0, "7", "a whole number that JSON held as 7.0"),
        (99999, "99999", "last whole one"),
        (64300000, "6.43e7", "as the paper prints it"),
        (10**400, "1.00e400", "beyond double"),
    ],
)
def test_short_distance(value, expected, why):
    assert numbers.short_distance(value) == expected, why


@pytest.mark.parametrize(
    "text, digits, expected, why",
    [
        ("0x1.8p+3", 6, "0x1.8p+3", "short stays"),
        ("0x1.123456789abcp+3", 4, "0x1.1234...p+3", "cut"),
        ("-0x1.123456789abcp-3", 4, "-0x1.1234...p-3", "the sign is not a digit"),
        ("0x1.1234567p+3", 4, "0x1.1234567p+3", "a cut that saves nothing is not made"),
        ("nan", 4, "nan", "not a hexfloat"),
    ],
)
def test_short_hexfloat(text, digits, expected, why):
    assert numbers.short_hexfloat(text, digits) == expected, why


@pytest.mark.parametrize(
    "left, right, expected, why",
    [
        (None, None, False, "null is not larger than null"),
        (0, None, True, "null is below everything"),
        (None, 0, False, "and never above"),
        (1, 1, False, "a tie stays with the first"),
        (INF, 10**400, True, "inf is above any integer"),
    ],
)
def test_larger(left, right, expected, why):
    assert numbers.larger(left, right) is expected, why


def test_rough_numbers_and_cells_of_maps_have_few_digits():
    rough = [437.784, 0.0754189, 8734.22, 1.5e7, 3.0, 0, None]
    told = ["438", "0.0754", "8730", "1.50e7", "3", "0", "-"]
    assert [numbers.rough(x) for x in rough] == told
    cells = [0.5, 9411, 11234.0, 5.42e126, 4.12e-8, numbers.INFINITE, 0, None]
    short = ["0.500", "9411", "1.1e4", "5e126", "4e-8", "inf", "0", "-"]
    assert [numbers.cell_of_map(x) for x in cells] == short
    assert numbers.cell_of_map(42 * 10**400) == "4e401"
