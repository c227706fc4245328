"""Tests of compare-output: what is found, what is refused, and what a reference takes to be replaced."""

import json
import math

import pytest

from compare_output import cli, numbers
from compare_output.problem import BAD_INPUT, DIFFERENT, ENVIRONMENT, NOTHING, PASS

REF = "body,x,n,shape\n0,1.0,3,sphere\n1,2.0,4,sphere\n2,-0.5,5,box\n"


@pytest.fixture
def files(tmp_path):
    """files(ref=TEXT, out=TEXT ...) writes them and returns their paths in that order."""

    def write(suffix="csv", **texts):
        paths = []
        for name, text in texts.items():
            path = tmp_path / f"{name}.{suffix}"
            path.write_bytes(text if isinstance(text, bytes) else text.encode())
            paths.append(str(path))
        return paths

    return write


def run(capfd, *words):
    code = cli.main(list(words))
    out, err = capfd.readouterr()
    return code, out, err


def found(capfd, *words):
    code, out, err = run(capfd, *words, "--json")
    return code, {f["field"]: f for f in json.loads(out)["fields"]}


# (what becomes of REF's text, further words, exit code, what is said)
OUTCOMES = [
    (REF, [], PASS, "all within"),
    (REF.replace("2.0", "2.0000000000000004"), [], DIFFERENT, "(x)"),
    (
        REF.replace("2.0", "2.0000000000000004"),
        ["--field", "x=ulp:1"],
        PASS,
        "all within",
    ),
    (
        REF.replace("2.0", "2.0000000000000009"),
        ["--field", "x=ulp:1"],
        DIFFERENT,
        "(x)",
    ),
    (REF.replace("2.0", "2.0000001"), ["--field", "x=ulp:1:float"], PASS, "all within"),
    (REF.replace("2.0", "2.02"), ["--field", "x=norm:0.011"], PASS, "all within"),
    (REF.replace("2.0", "2.02"), ["--field", "x=norm:0.009"], DIFFERENT, "body 1"),
    (REF.replace("2.0", "7"), ["--field", "x=noise"], PASS, "ignored"),
    (REF.replace(",4,", ",5,"), ["--field", "x=norm:1"], DIFFERENT, "(n)"),
    (REF.replace("box", "cube"), [], DIFFERENT, "(shape)"),
    # Rows in another order, and one too few or too many.
    (
        "body,x,n,shape\n2,-0.5,5,box\n0,1.0,3,sphere\n1,2.0,4,sphere\n",
        [],
        PASS,
        "by body",
    ),
    (
        "body,x,n,shape\n0,1.0,3,sphere\n2,-0.5,5,box\n",
        [],
        DIFFERENT,
        "only REF has body 1",
    ),
    (REF + "3,0,0,box\n", [], DIFFERENT, "only OUT has body 3"),
    # Fields in another order, and one too few.
    (
        "shape,n,x,body\nsphere,3,1.0,0\nsphere,4,2.0,1\nbox,5,-0.5,2\n",
        [],
        PASS,
        "all within",
    ),
    (
        "body,x,n\n0,1.0,3\n1,2.0,4\n2,-0.5,5\n",
        [],
        DIFFERENT,
        "only REF has the field shape",
    ),
    # What is no number agrees with nothing but itself, whatever the limit.
    (
        REF.replace("2.0", "nan"),
        ["--field", "x=norm:1e300"],
        DIFFERENT,
        "NaN or infinite in one",
    ),
    (
        REF.replace("2.0", "inf"),
        ["--field", "x=ulp:1e300"],
        DIFFERENT,
        "NaN or infinite in one",
    ),
]


@pytest.mark.parametrize("text, words, wanted, said", OUTCOMES)
def test_outcome(files, capfd, text, words, wanted, said):
    code, out, err = run(capfd, *files(ref=REF, out=text), *words)
    assert code == wanted, out + err
    assert said in out


def test_nan_beside_nan_and_equal_infinities_agree(files, capfd):
    text = REF.replace("2.0", "nan").replace("-0.5", "-inf")
    code, fields = found(capfd, *files(ref=text, out=text))
    assert code == PASS and fields["x"]["different"] == 0


def test_digits_are_those_that_agree(files, capfd):
    ref = "step,x\n" + "".join(f"{i},1.0\n" for i in range(200))
    out = ref.replace("\n7,1.0", "\n7,1.001").replace("\n8,1.0", "\n8,1.00001")
    _, fields = found(capfd, *files(ref=ref, out=out), "--field", "x=noise")
    digits = fields["x"]["digits"]
    assert digits["least"] == pytest.approx(3, abs=0.01)
    assert digits["one_percent"] == pytest.approx(5, abs=0.01)
    assert digits["median"] == "all"


def test_the_first_record_that_parts_is_named_with_its_lines(files, capfd):
    ref = "step,x,y\n1,1,1.5\n2,2,2.5\n3,3,3.5\n"
    out = "step,x,y\n1,1,1.5\n2,2,2.6\n3,4,3.6\n"
    paths = files(ref=ref, out=out)
    _, text, _ = run(capfd, *paths)
    assert "first record that parts: step 2" in text
    assert f"REF  2.5  ({paths[0]}:3)" in text and f"OUT  2.6  ({paths[1]}:3)" in text
    assert "x " not in text.split("first record")[1]


def three(error_ref, error_out, digits=30):
    """REF, OUT and WIDE of 1/(i+3), with relative errors."""
    wide, ref, out = ["i,x"], ["i,x"], ["i,x"]
    for i in range(50):
        top = 10 ** (digits + 1) // (i + 3)
        wide.append(f"{i},0.{top // 10:0{digits}d}")
        value = 1 / (i + 3)
        ref.append(f"{i},{value * (1 + error_ref * math.cos(i))!r}")
        out.append(f"{i},{value * (1 + error_out * math.sin(i))!r}")
    return {"ref": "\n".join(ref), "out": "\n".join(out), "wide": "\n".join(wide)}


@pytest.mark.parametrize(
    "error_ref, error_out, wanted, whose",
    [
        (1e-7, 1e-14, PASS, "REF"),  # float's error, seen by a double
        (1e-14, 1e-7, DIFFERENT, "OUT"),
        (1e-12, 2e-12, PASS, "both"),  # within four times the error that REF has itself
        (1e-12, 9e-12, DIFFERENT, "both"),
        (0, 0, PASS, None),  # both the nearest doubles: no tolerance but the roundoff
    ],
)
def test_a_wide_output_tells_whose_error_it_is(
    files, capfd, error_ref, error_out, wanted, whose
):
    code, fields = found(capfd, *files(**three(error_ref, error_out)))
    assert code == wanted and fields["x"]["whose_error"] == whose


def test_digits_beyond_a_double_are_read(files, capfd):
    """The nearest double of 1/3 is off by 2^-54/3 relative to it: seen only where the wide text is read in full."""
    texts = {"ref": f"i,x\n0,{1 / 3!r}\n", "out": f"i,x\n0,{1 / 3!r}\n"}
    _, fields = found(capfd, *files(**texts, wide="i,x\n0,0." + "3" * 34 + "\n"))
    assert fields["x"]["digits_ref"]["least"] == pytest.approx(
        -math.log10(2.0**-54), abs=0.01
    )


def test_the_third_word_and_wide_are_the_same(files, capfd):
    paths = files(**three(1e-9, 1e-9))
    assert run(capfd, *paths) == run(capfd, *paths[:2], "--wide", paths[2])


REFUSED = [
    (
        "",
        REF,
        [],
        "out.csv",
        "empty",
    ),  # placeholder order: ref text, out text, words, place, said
    (REF, REF + "3,1.0\n", [], "out.csv:5", "2 values, but 4"),
    (REF, REF + "2,1.0,3,box\n", [], "out.csv:5", "the same body"),
    (REF, REF.replace("body", "x"), [], "out.csv", "two fields are called 'x'"),
    (REF, b"\xff\xfe\x00", [], "out.csv", "not UTF-8"),
    (REF, REF.replace("2.0", "1e999"), [], "out.csv", "beyond the range"),
    (REF, REF, ["--field", "x=ulp"], "--field", "a limit is wanted"),
    (REF, REF, ["--field", "x=ulp:nan"], "--field", "not a finite number"),
    (REF, REF, ["--field", "x=near:1"], "--field", "no class of that name"),
    (REF, REF, ["--field", "x=ulp:1:half"], "--field", "TYPE is one of"),
    (REF, REF, ["--field", "y=exact"], "no field fits y", "there are"),
    (REF, REF, ["--field", "shape=norm:1"], "'shape'", "holds texts"),
    (REF, REF, ["--field", "x=derived"], "'x'", "WIDE"),
    (REF, REF, ["--key", "id"], "'id'", "there are body"),
    (REF, REF, ["--bless"], "--reason", "kept beside"),
    (REF, REF, ["--reason", "x"], "--reason", "is for --bless"),
    (REF, REF, ["--bless", "--new", "--reason", "x"], "ref.csv", "is there already"),
    (REF, REF, ["--limits", "nowhere.toml"], "nowhere.toml", "No such file"),
    (REF, REF, ["--nonsense"], "--nonsense", "--help"),
]


@pytest.mark.parametrize("ref, out, words, place, said", REFUSED)
def test_refused(files, capfd, ref, out, words, place, said):
    paths = files(ref=ref, out=out)
    if not ref:
        place = "ref.csv"
    code, _, err = run(capfd, *paths, *words)
    assert code == BAD_INPUT, err
    assert place in err and said in err


def test_a_wide_without_some_rows_derives_nothing(files, capfd):
    texts = three(1e-9, 1e-9)
    texts["wide"] = texts["wide"].rsplit("\n", 1)[0]
    code, _, err = run(capfd, *files(**texts))
    assert code == BAD_INPUT and "no error can be derived" in err


def test_no_rows_are_nothing_compared(files, capfd):
    assert run(capfd, *files(ref="a,b\n", out="a,b\n"))[0] == NOTHING


def test_what_is_all_noise_is_nothing_judged(files, capfd):
    paths = files(ref="i,x\n0,1\n1,2\n", out="i,x\n0,1\n1,5\n")
    assert run(capfd, *paths, "--key", "i", "--field", "x=noise")[0] == NOTHING


@pytest.mark.parametrize("limit", ["exact", "ulp:1e9", "norm:0.5"])
def test_a_difference_beyond_the_range_of_a_double_is_one(files, capfd, limit):
    paths = files(ref="i,x\n0,1e308\n", out="i,x\n0,-1e308\n")
    code, fields = found(capfd, *paths, "--key", "i", "--field", f"x={limit}")
    assert code == DIFFERENT and fields["x"]["digits"]["least"] == 0
    wide = ["--wide", paths[0], "--field", "x=derived"]
    assert run(capfd, *paths, "--key", "i", *wide)[0] == DIFFERENT


def test_a_file_of_limits(files, capfd, tmp_path):
    limits = tmp_path / "limits.toml"
    limits.write_text('[fields]\n"*" = "norm:1e-3"\nn = "exact"\nshape = "exact"\n')
    paths = files(ref=REF, out=REF.replace("2.0", "2.0001"))
    assert run(capfd, *paths, "--limits", str(limits))[0] == PASS
    # The command line has the last word.
    assert (
        run(capfd, *paths, "--limits", str(limits), "--field", "x=exact")[0]
        == DIFFERENT
    )
    limits.write_text("[fields]\nx = 3\n")
    code, _, err = run(capfd, *paths, "--limits", str(limits))
    assert code == BAD_INPUT and str(limits) in err


def test_directories_are_compared_by_the_names_of_their_files(tmp_path, capfd):
    for side in ("ref", "out"):
        (tmp_path / side / "series").mkdir(parents=True)
        (tmp_path / side / "series/a.csv").write_text(REF)
        (tmp_path / side / "context.json").write_text("{}")
    words = [str(tmp_path / "ref"), str(tmp_path / "out")]
    assert run(capfd, *words)[0] == PASS
    (tmp_path / "out/b.csv").write_text(REF)
    code, text, _ = run(capfd, *words)
    assert code == DIFFERENT and "REF has no b.csv" in text
    code, _, err = run(capfd, words[0], str(tmp_path / "out/b.csv"))
    assert code == BAD_INPUT and "all files or all directories" in err


def test_the_type_in_a_name_tells_no_files_apart(tmp_path, capfd):
    wide = REF.replace("2.0", "2.0000000000000000000001")
    for side, text in (("float", REF), ("double", REF), ("mpfr62", wide)):
        (tmp_path / side).mkdir()
        (tmp_path / side / f"a_{side}_10.csv").write_text(text)
        (tmp_path / side / "doubles.csv").write_text(REF)
    float_, double, mpfr62 = (
        str(tmp_path / side) for side in ("float", "double", "mpfr62")
    )
    code, text, _ = run(capfd, float_, double, mpfr62)
    assert code == PASS and "a_double_10.csv" in text and "a_mpfr62_10.csv" in text
    # Where one directory holds both types, only its own name fits a file.
    (tmp_path / "float/a_double_10.csv").write_text(REF.replace("2.0", "2.5"))
    code, text, _ = run(capfd, float_, double)
    assert code == DIFFERENT and "OUT has no a_float_10.csv" in text
    assert "(x)" in text
    # And a new reference has the name of the old one.
    (tmp_path / "float/a_double_10.csv").unlink()
    code, _, err = run(capfd, float_, double, "--bless", "--reason", "x")
    assert code == BAD_INPUT and "a_float_10.csv: OUT has no such file" in err


def test_bless_takes_a_reason_and_keeps_it(files, capfd, tmp_path):
    new = REF.replace("2.0", "2.5")
    ref, out = files(ref=REF, out=new)
    code, text, err = run(capfd, ref, out, "--bless", "--reason", "glibc 2.41")
    assert code == PASS and "(x)" in text, err
    assert (tmp_path / "ref.csv").read_text() == new
    (line,) = (tmp_path / "ref.csv.blessed.jsonl").read_text().splitlines()
    entry = json.loads(line)
    assert entry["reason"] == "glibc 2.41" and "(x)" in entry["found"]
    assert entry["files"][0]["before"] != entry["files"][0]["after"]
    code, _, err = run(capfd, ref, out, "--bless", "--reason", "again")
    assert code == PASS and "nothing to bless" in err
    assert len((tmp_path / "ref.csv.blessed.jsonl").read_text().splitlines()) == 1


def test_bless_removes_nothing(tmp_path, capfd):
    for side, name in (("ref", "a"), ("ref", "b"), ("out", "a")):
        (tmp_path / side).mkdir(exist_ok=True)
        (tmp_path / side / f"{name}.csv").write_text(REF)
    words = [str(tmp_path / "ref"), str(tmp_path / "out"), "--bless", "--reason", "x"]
    code, _, err = run(capfd, *words)
    assert code == BAD_INPUT and "b.csv: OUT has no such file" in err


def test_a_name_with_a_colon(files, capfd):
    ref, out = files(ref="i,a:b\n0,1\n1,2\n", out="i,a:b\n0,1\n1,3\n")
    _, text, _ = run(capfd, ref, out)
    assert f"REF  2  ({ref}:3)" in text


def test_a_mistyped_name_becomes_no_reference(files, capfd, tmp_path):
    (out,) = files(out=REF)
    ref = str(tmp_path / "rfe.csv")
    code, _, err = run(capfd, ref, out, "--bless", "--reason", "first")
    assert code == BAD_INPUT and "--new" in err and not (tmp_path / "rfe.csv").exists()
    code, _, err = run(capfd, ref, out, "--bless", "--new", "--reason", "first")
    assert code == PASS and (tmp_path / "rfe.csv").read_text() == REF, err


def test_an_output_that_cannot_be_read_becomes_no_reference(files, capfd, tmp_path):
    (out,) = files(out=REF + "torn,")
    code, _, err = run(
        capfd, str(tmp_path / "ref.csv"), out, "--bless", "--new", "--reason", "x"
    )
    assert code == BAD_INPUT and not (tmp_path / "ref.csv").exists(), err


def test_a_full_disk_is_said_and_loses_no_reference(
    files, capfd, tmp_path, monkeypatch
):
    ref, out = files(ref=REF, out=REF.replace("2.0", "3"))

    def full(*_):
        raise OSError(28, "No space left on device", str(ref) + ".part")

    monkeypatch.setattr("shutil.copyfile", full)
    code, _, err = run(capfd, ref, out, "--bless", "--reason", "x")
    assert code == ENVIRONMENT and "No space left" in err
    assert (tmp_path / "ref.csv").read_text() == REF


# Numbers as texts.
@pytest.mark.parametrize(
    "text, high, low",
    [
        ("0.1", 0.1, 0.0),
        ("-1.5d3", -1500.0, 0.0),
        ("0x1.8p+3", 12.0, 0.0),
        ("-0x1p-1074", -(2.0**-1074), 0.0),
        ("0x1.00000000000000000001p0", 1.0, 2.0**-80),
        ("0.1000000000000000000000000000000000", 0.1, -5.551115123125783e-18),
        ("9007199254740993", 9007199254740992.0, 0.0),
        ("900719925474099300", 900719925474099328.0, -28.0),
    ],
)
def test_a_text_is_high_and_low(text, high, low):
    n = numbers.of_texts([text])
    assert (n.high[0], n.low[0]) == (high, pytest.approx(low, rel=1e-15))


def test_columns_by_spaces_tabs_and_names_in_a_comment(files, capfd):
    for separator in (" ", "\t", ";", "   "):
        text = separator.join("# t x y".split()[1:])
        rows = "".join(
            separator.join((str(i), f"{i}.5", "1e-3")) + "\n" for i in range(3)
        )
        code, fields = found(
            capfd, *files(ref=f"# {text}\n{rows}", out=f"# {text}\n{rows}")
        )
        assert code == PASS and {"x", "y"} <= set(fields)
