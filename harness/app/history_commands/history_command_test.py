"""Tests of ulpgate history's file: one run is one, nobody's file is touched, and what fails leaves everything as it was."""

import json
import os
import pathlib
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "testing"))

from program import ROOT, ULPGATE, run  # noqa: E402

SIZE = ["--samples", "200", "--strata", "uniform,edges", "--timing"]


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Directories: the same rows at two seeds, one with repeated times."""
    folder = tmp_path_factory.mktemp("runs")
    words = ["math", "--functions", "exp,sin", "--types", "double"]
    for name, more in (
        ("a", ["off"]),
        ("timed", ["repeats", "--timing-processes", "3", "--timing-rounds", "2"]),
        ("other", ["off", "--seed", "2"]),
    ):
        assert run(*words, *SIZE, *more, "--out", folder / name)[0] == 0
    return folder


def run_as(*words, cwd=ROOT, **more):
    """In another directory, or as another process than a test is."""
    done = subprocess.run(
        [ULPGATE, *map(str, words)], capture_output=True, text=True, cwd=cwd, **more
    )
    return done.returncode, done.stdout, done.stderr


def add(database, directory, *more, **options):
    return run_as("history", "--add", directory, "--db", database, *more, **options)


def content(database):
    with sqlite3.connect(database) as connection:
        return list(connection.iterdump())


def test_a_run_is_there_once_and_of_each_commit(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    assert add(file, runs / "a", "--commit", "one")[0] == 0
    before = content(file)
    code, _, err = add(file, runs / "a", "--commit", "one")
    assert code == 0 and "has it already" in err
    assert content(file) == before
    assert add(file, runs / "a", "--commit", "two")[0] == 0
    with sqlite3.connect(file) as connection:
        assert connection.execute("SELECT count(*) FROM runs").fetchone() == (2,)
        # Deterministic figures stand once.
        results = connection.execute("SELECT count(*) FROM results").fetchone()
        rows = connection.execute("SELECT count(*) FROM measurements").fetchone()
        assert rows[0] == 2 * results[0]
        assert connection.execute("PRAGMA user_version").fetchone() == (1,)
    code, out, _ = run("history", "--steps", "--db", file)
    assert (code, out) == (0, "")


def test_several_directories_are_added_together_or_not_at_all(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    broken = tmp_path / "broken"
    shutil.copytree(runs / "a", broken)
    with (broken / "math.jsonl").open("a") as records:
        records.write("{}\n")
    both = ["--add", runs / "a", "--add", broken, "--commit", "one"]
    code, _, err = run("history", *both, "--db", file)
    assert code == 2 and f"{broken}/math.jsonl" in err
    assert not file.exists()


def test_seeds_are_series_of_their_own(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    for name in ("a", "other"):
        assert add(file, runs / name, "--commit", name)[0] == 0
    code, out, _ = run("history", "exp", "double", "--db", file, "--json")
    found = json.loads(out)
    drawn = [s for s in found["series"] if s["setting"].startswith("uniform")]
    assert code == 0 and found["steps"] == []
    assert sorted(s["setting"].split()[2] for s in drawn) == ["1", "2"]
    assert all(len(s["values"]) == 1 for s in drawn)


def test_times_stand_beside_the_errors(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    assert add(file, runs / "timed", "--commit", "one")[0] == 0
    code, out, _ = run("history", "exp", "double", "--db", file, "--json")
    times = [s for s in json.loads(out)["series"] if s["kind"] == "time"]
    assert code == 0 and len(times) == 1 and times[0]["values"][0]["value"] > 0
    rows = (runs / "timed/timing_repeats.jsonl").read_text().splitlines()
    for row in map(json.loads, rows):
        # Two rounds in each of three processes.
        for times in (row["ns"], row["baseline_ns"]):
            assert [len(process) for process in times] == [2, 2, 2]
            assert min(map(min, times)) > 0
    # The records are those of any other timing.
    assert (runs / "timed/math.jsonl").read_bytes() == (
        runs / "a/math.jsonl"
    ).read_bytes()


def test_the_commit_is_what_is_checked_out(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    code, _, err = add(file, runs / "a", cwd=tmp_path)
    assert code == 2 and "--commit REV" in err and not file.exists()
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@b"]
    tree = tmp_path / "tree"
    subprocess.run(["git", "init", "-q", tree], check=True)
    (tree / "file").write_text("1")
    subprocess.run([*git, "add", "file"], cwd=tree, check=True)
    subprocess.run([*git, "commit", "-qm", "1"], cwd=tree, check=True)
    head = subprocess.check_output(["git", "rev-parse", "HEAD"], cwd=tree, text=True)
    assert add(file, runs / "a", cwd=tree)[0] == 0
    (tree / "file").write_text("2")
    assert add(file, runs / "a", cwd=tree)[0] == 0
    with sqlite3.connect(file) as connection:
        found = connection.execute("SELECT commit_id FROM runs ORDER BY id").fetchall()
    assert found == [(head.strip(),), (head.strip() + "-dirty",)]


REFUSED = [
    (["history"], 2, "FUNCTION TYPE, --steps or --add"),
    (["history", "exp"], 2, "FUNCTION TYPE"),
    (["history", "exp", "double", "--steps"], 2, "one of them"),
    (["history", "--steps", "--commit", "x"], 2, "of --add"),
    (["history", "--steps", "--db", "none.sqlite"], 2, "no history is there"),
    (["history", "--steps", "--db", "."], 2, "not a file"),
    (["history", "--add", "nowhere", "--commit", "x"], 2, "nowhere/context.json"),
]


@pytest.mark.parametrize("words, code, message", REFUSED)
def test_what_is_refused(words, code, message, tmp_path):
    found, out, err = run_as(*words, cwd=tmp_path)
    assert found == code and message in err and out == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("commit", ["a b", "", "x" * 101, "a;b", "ü"])
def test_a_commit_is_a_word(runs, tmp_path, commit):
    code, _, _ = add(tmp_path / "h.sqlite", runs / "a", "--commit", commit)
    assert code == 2 and list(tmp_path.iterdir()) == []


def test_a_name_that_is_not_there_gets_a_hint(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    assert add(file, runs / "a", "--commit", "one")[0] == 0
    code, _, err = run("history", "epx", "double", "--db", file)
    assert code == 2 and "exp" in err
    code, _, err = run("history", "exp", "float", "--db", file)
    assert code == 3 and "exp in float" in err


def test_an_unfinished_run_is_no_run(runs, tmp_path):
    shard = ["--shard", "0/2", "--out", tmp_path / "s"]
    math = ["math", "--functions", "exp", "--types", "double", *SIZE, "off"]
    assert run(*math, *shard)[0] == 0
    code, _, err = add(tmp_path / "h.sqlite", tmp_path / "s", "--commit", "x")
    assert code == 3 and "not complete" in err


def test_files_of_others_stay_as_they_are(runs, tmp_path):
    text = tmp_path / "text"
    text.write_text("This is no database, and long enough to look like one.\n" * 40)
    foreign = tmp_path / "foreign.sqlite"
    with sqlite3.connect(foreign) as connection:
        connection.execute("CREATE TABLE t(x)")
    newer = tmp_path / "newer.sqlite"
    assert add(newer, runs / "a", "--commit", "x")[0] == 0
    with sqlite3.connect(newer) as connection:
        connection.execute("PRAGMA user_version = 2")
    for file, message in (
        (text, "not a database"),
        (foreign, "no history of ulpgate"),
        (newer, "newer ulpgate"),
    ):
        before = file.read_bytes()
        for words in (["--add", runs / "a", "--commit", "y"], ["--steps"]):
            code, _, err = run("history", *words, "--db", file)
            assert code == 2 and message in err and str(file) in err
        assert file.read_bytes() == before


def test_many_writers_lose_nothing(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    words = ["history", "--add", runs / "a", "--db", file, "--commit"]
    writers = [
        subprocess.Popen(
            [ULPGATE, *map(str, words), f"c{i % 6}"], stderr=subprocess.PIPE
        )
        for i in range(12)
    ]
    for writer in writers:
        _, err = writer.communicate()
        assert writer.returncode == 0, err
    with sqlite3.connect(file) as connection:
        commits = connection.execute("SELECT commit_id FROM runs").fetchall()
        counts = connection.execute("SELECT count(*) FROM measurements GROUP BY run")
        assert sorted(commits) == [(f"c{i}",) for i in range(6)]
        assert len(set(counts.fetchall())) == 1
        assert connection.execute("PRAGMA integrity_check").fetchone() == ("ok",)


def limited(size):
    """A process whose files may not grow beyond a size: a write fails as on a full disk, and no signal ends it."""

    def prepare():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return prepare


def test_a_full_disk_loses_nothing(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    assert add(file, runs / "a", "--commit", "one")[0] == 0
    before = content(file)
    for size in (0, 4096, 16384, 49152):
        code, _, err = add(
            file, runs / "timed", "--commit", "two", preexec_fn=limited(size)
        )
        assert code == 4 and str(file) in err and "nothing was changed" in err, size
        assert content(file) == before
    assert add(file, runs / "timed", "--commit", "two")[0] == 0
    assert len(content(file)) > len(before)


def test_a_killed_writer_leaves_what_was_there(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    assert add(file, runs / "a", "--commit", "one")[0] == 0
    before = content(file)
    # A journal of a transaction that nobody finished, as after a power cut: the next process undoes it.
    with sqlite3.connect(file, isolation_level=None) as connection:
        connection.execute("PRAGMA cache_size = 1")
        connection.execute("BEGIN IMMEDIATE")
        connection.execute("DELETE FROM measurements")
        connection.execute("UPDATE runs SET commit_id = 'torn'")
        connection.execute("CREATE TABLE filler(x)")
        for _ in range(200):
            connection.execute("INSERT INTO filler VALUES(randomblob(4096))")
        torn = tmp_path / "torn.sqlite"
        shutil.copy(file, torn)
        journal = tmp_path / "h.sqlite-journal"
        assert journal.exists() and torn.read_bytes() != b""
        shutil.copy(journal, tmp_path / "torn.sqlite-journal")
        connection.execute("ROLLBACK")
    assert add(torn, runs / "a", "--commit", "one")[0] == 0
    assert content(torn) == before


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_a_file_without_permission(runs, tmp_path):
    file = tmp_path / "h.sqlite"
    assert add(file, runs / "a", "--commit", "one")[0] == 0
    file.chmod(0o444)
    code, _, err = add(file, runs / "a", "--commit", "two")
    assert code == 4 and str(file) in err


def test_a_folder_that_is_not_there(runs, tmp_path):
    code, _, err = add(tmp_path / "none" / "h.sqlite", runs / "a", "--commit", "one")
    assert code == 4 and "cannot open" in err
