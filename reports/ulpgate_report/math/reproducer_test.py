"""A reproducer calls the code that was judged."""
from ulpgate_report.math import reproducer

PLAN = """ulpgate math plan
types float,double
code float sin --library libsleef.so.3 --symbol Sleef_sinf8_u10avx2 path=/usr/lib/libsleef.so.3.5.1 soname=libsleef.so.3 signature=v8f(v8f)
code double sin --library '/opt/my libs/m.so' --symbol my_sin --signature 'd(d)' path=/opt/my libs/m.so soname=
code double pow --library - --symbol pow --worker musl/worker path=musl/worker soname= build_id=
"""


def test_other_code_is_called_with_the_options_of_its_plan():
    context = {"plan_text": PLAN}
    assert reproducer.command_of(context, "sin", "float", ("0x1p+0",)) == (
        "ulpgate at sin float 0x1p+0 --library libsleef.so.3 --symbol Sleef_sinf8_u10avx2"
    )
    assert reproducer.options_of(context, "sin", "double") == (
        " --library '/opt/my libs/m.so' --symbol my_sin --signature 'd(d)'"
    )
    assert reproducer.command_of(context, "pow", "double", ("0x1p+0", "-0x1p-3")) == (
        "ulpgate at pow double 0x1p+0 -0x1p-3 --library - --symbol pow --worker musl/worker"
    )


def test_the_programs_own_code_needs_no_option():
    for context in ({}, {"plan_text": "ulpgate math plan\n"}, {"plan_text": PLAN}):
        command = reproducer.command_of(context, "cos", "double", ("0x1p+0",))
        assert command == "ulpgate at cos double 0x1p+0"
