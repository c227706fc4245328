"""Tests of the energy account: parts that are added, exact balances, instants without an account."""
import pytest

from ulpgate_report.records import energy_account, records
from ulpgate_report.testing import sample_scenes
from ulpgate_report.testing.sample_scenes import short_columns


@pytest.mark.parametrize(
    "given, expected, why",
    [
        ({"kinetic_half_step_J": (1, 2, 3)}, None, "no account"),
        (
            {"translational_on_step_J": (1, 2, 3), "elastic_J": (3, 2, 2)},
            [0.0, 0.0, 1.0],
            "the parts are added",
        ),
        (
            {
                "translational_on_step": (1, 2, 3),
                "elastic": (3, 2, 2),
                "sum": (4, 4, 6),
            },
            [0.0, 0.0, 2.0],
            "a sum in the file is taken",
        ),
    ],
)
def test_balance(given, expected, why):
    found = energy_account.balance(short_columns(**given))
    assert (found and found[1]) == expected, why


def test_the_instant_before_the_first_step_has_no_account():
    series = short_columns(
        translational_on_step=(0, 1, 2), elastic=(0, 3, 2), sum=(0, 4, 4)
    )
    times, errors = energy_account.balance(series)
    assert times == [0.1, 0.2] and errors == [0.0, 0.0]


def test_angles_and_errors_are_no_parts_of_the_energy():
    series = short_columns(
        **{"kinetic_half_step_J": (9, 9, 9), "translational_on_step": (1, 2, 3)},
        **{"elastic": (3, 2, 1), "angle_1_rad": (1, 2, 3)},
        **{"angle_product": (1, 2, 3), "raw_energy_error_J": (1, 2, 3)},
    )
    assert list(energy_account.parts(series)) == ["translational_on_step", "elastic"]


def test_a_balance_is_exact_far_below_a_double(tmp_path):
    directory = sample_scenes.write_sample(tmp_path, ("mpfr150",), bodies=1)
    scenes = records.load(directory).scenes
    times, errors = energy_account.balance(scenes.series["deposition", "mpfr150"])
    assert errors[0] == 0 and len(times) == len(errors)
    assert all(1e-151 < error < 1e-147 for error in errors[1:])
