"""Published numbers that a table or figure shows beside ours, and where they stand."""
from ulpgate_report.values import time_step

# J. Kozicki, A. Gladky, K. Thoeni, Implementation of high-precision computation capabilities into the open-source
# dynamic simulation framework YADE, Comput. Phys. Commun. 270 (2022) 108167: how long the triple elastic pendulum
# correlates over 0.9 with its run in 150 digits, in s, at a step of 1e-5 s without damping.
PENDULUM_T_S = {
    "float": 1.1,
    "double": 2.5,
    "long_double": 3.1,
    "float128": 5.1,
    "mpfr62": 9.9,
    "cpp_bin_float62": 9.9,
}
PENDULUM = "pendulum3"
CITATION = "J. Kozicki, A. Gladky, K. Thoeni, Comput. Phys. Commun. 270 (2022) 108167"
_MASS = "mass=yade"
# What a caption says of a name that stands in it.
MEANINGS = {
    PENDULUM: "a chain of three elastic rods, its first node fixed",
    _MASS: "4/3 pi of the nodes' mass is a product of doubles in every type, as in the published runs",
}
_DT_S = 1e-5


def overrides(variant):
    """The overrides of a variant: its commas stand between them."""
    return [one for one in variant.split(",") if one]


def pendulum_t_s(scene, dt, variant, token):
    """The published duration, None where the run is not the published one."""
    others = [o for o in overrides(variant) if o != _MASS and not o.startswith("dt=")]
    of_paper = scene == PENDULUM and _MASS in overrides(variant) and not others
    if not of_paper or time_step.seconds(dt) != _DT_S:
        return None
    return PENDULUM_T_S.get(token)
