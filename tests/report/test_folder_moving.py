"""A run folder is replaced by one exchange of names; what a process that died has left is brought back, and nothing else is touched."""

import errno
import multiprocessing
import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from sample_designs import four_bar_result, four_bar_scene

from drivewright import atomic
from drivewright.atomic import hold, is_held, replacing, write_text
from drivewright.report import moving, renames
from drivewright.report.content import Views
from drivewright.report.folder import OURS, recover_run_folder, refuse_foreign, write_run_folder

pytestmark = pytest.mark.interface

TOKEN = "0123456789abcdef"
needs_locks = pytest.mark.skipif(sys.platform == "win32", reason="no locks on folders")


@pytest.fixture(params=["exchange", "two renames"])
def system(request, monkeypatch):
    """With and without an exchange of two names."""
    if request.param == "two renames":
        monkeypatch.setattr(renames, "_renameat2", lambda: None)
    elif renames._renameat2() is None:
        pytest.skip("this system cannot exchange two names")
    return request.param


def write(out, title="run"):
    return write_run_folder(four_bar_result(title), out, figures=False, seen=Views(four_bar_scene()))


def texts(folder):
    return {str(path.relative_to(folder)): path.read_text() for path in folder.rglob("*.txt")}


def remnant(out, role, **files):
    """A folder as a run that was killed leaves it, with files of a person in it."""
    left = out.with_name(f"{out.name}.{role}-{TOKEN}")
    (left / "tables").mkdir(parents=True)
    (left / "result.json").write_text('{"drivewright": "0"}')
    for name, text in files.items():
        file = left / name.replace("__", "/").replace("_", ".")
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
    return left


@pytest.mark.parametrize("role", ["tmp", "old"])
def test_what_a_killed_run_left_comes_back(tmp_path, system, role):
    out = write(tmp_path / "run")
    left = remnant(out, role, notes_txt="mine", cad__part_txt="drawing")
    recover_run_folder(out)
    assert not left.exists() and texts(out) == {"notes.txt": "mine", "cad/part.txt": "drawing"}


def test_a_folder_that_was_moved_aside_and_not_replaced_comes_back_whole(tmp_path):
    left = remnant(tmp_path / "run", "old", notes_txt="mine")
    recover_run_folder(tmp_path / "run")
    assert not left.exists() and texts(tmp_path / "run") == {"notes.txt": "mine"} and (tmp_path / "run" / "result.json").is_file()


def test_a_file_that_differs_from_the_one_there_lies_beside_it(tmp_path, system):
    out = write(tmp_path / "run")
    (out / "notes.txt").write_text("new")
    (out / "same.txt").write_text("same")
    remnant(out, "tmp", notes_txt="old", same_txt="same")
    recover_run_folder(out)
    found = texts(out)
    assert found.pop("notes.txt") == "new" and found.pop("same.txt") == "same"
    ((name, text),) = found.items()
    assert name.startswith("notes.recovered-") and text == "old"


@pytest.mark.parametrize(("ours", "theirs"), [("folder", "folder"), ("folder", "file"), ("file", "folder")])
def test_a_name_that_somebody_takes_between_the_look_and_the_rename_is_theirs(tmp_path, monkeypatch, ours, theirs):
    """Without the system's call the name is looked at first, and another process may be quicker."""
    monkeypatch.setattr(renames, "_renameat2", lambda: None)
    monkeypatch.setattr(renames.os.path, "lexists", lambda path: False)
    source, target = tmp_path / "source", tmp_path / "target"
    for path, form in ((source, ours), (target, theirs)):
        if form == "folder":
            path.mkdir()
            (path / "notes.txt").write_text(path.name)
        else:
            path.write_text(path.name)
    assert not renames.move(source, target) and source.exists()
    assert (target / "notes.txt" if theirs == "folder" else target).read_text() == "target"


def test_files_of_a_person_stay_where_there_is_no_run_folder_to_bring_them_to(tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "thesis.tex").write_text("mine")
    left = remnant(tmp_path / "run", "tmp", notes_txt="mine too")
    recover_run_folder(tmp_path / "run")
    assert texts(left) == {"notes.txt": "mine too"} and [path.name for path in (tmp_path / "run").iterdir()] == ["thesis.tex"]


@pytest.mark.parametrize(
    "name", ["run.old-123", "run.tmp-4711", f"run.old-{TOKEN}.bak", f"running.old-{TOKEN}", "run.old-0123456789ABCDEF"]
)
def test_nothing_else_is_taken_for_a_remnant(tmp_path, name):
    """An older version named its folders by its process id, which a later process may have too."""
    (tmp_path / name).mkdir()
    (tmp_path / name / "notes.txt").write_text("mine")
    write(tmp_path / "run")
    write(tmp_path / "run")
    assert texts(tmp_path / name) == {"notes.txt": "mine"}


def test_a_link_with_such_a_name_is_not_followed(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "result.json").write_text("mine")
    (tmp_path / f"run.tmp-{TOKEN}").symlink_to(tmp_path / "elsewhere")
    write(tmp_path / "run")
    assert (tmp_path / "elsewhere" / "result.json").read_text() == "mine"


@needs_locks
def test_what_a_living_run_writes_is_left_alone(tmp_path):
    out = write(tmp_path / "run")
    with moving.replacing_folder(moving.Place(out, OURS, refuse_foreign)) as fresh:
        (fresh / "result.json").write_text('{"drivewright": "0"}')
        done = subprocess.run([sys.executable, "-c", RECOVER, out])
        assert done.returncode == 0 and (fresh / "result.json").is_file()
    assert (out / "result.json").read_text() == '{"drivewright": "0"}' and os.listdir(tmp_path) == ["run"]


RECOVER = "import sys; from drivewright.report.folder import recover_run_folder; recover_run_folder(sys.argv[1])"


@needs_locks
def test_a_lock_ends_with_its_process(tmp_path):
    with hold(tmp_path):
        assert is_held(tmp_path)
    assert not is_held(tmp_path)


def _many(out, title, times):
    for _ in range(times):
        write(out, title)
        while True:
            try:
                write_text(out / "cad" / f"{title}.txt", title)
                break
            except FileNotFoundError:  # another one has just replaced the folder
                continue


@needs_locks
def test_several_processes_at_one_folder_lose_nothing(tmp_path, system):
    """Each writes the run folder, and a file of its own into it, again and again."""
    context = multiprocessing.get_context("fork")
    write(tmp_path / "run")
    (tmp_path / "run" / "notes.txt").write_text("mine")
    writers = [context.Process(target=_many, args=(tmp_path / "run", f"writer{n}", 6)) for n in range(4)]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join(60)
    found = texts(tmp_path / "run")
    assert found.pop("notes.txt") == "mine"
    assert [writer.exitcode for writer in writers] == [0] * 4
    assert set(found.values()) == {f"writer{n}" for n in range(4)}
    assert os.listdir(tmp_path) == ["run"]


def test_an_empty_folder_and_a_link_to_one_are_taken(tmp_path, system):
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    assert write(tmp_path / "link") == tmp_path / "real" and (tmp_path / "link" / "result.json").is_file()


# -- a file --------------------------------------------------------------------------------------------------------------------


def test_a_file_appears_whole_or_not_at_all(tmp_path):
    file = tmp_path / "table.csv"
    write_text(file, "first")
    with pytest.raises(ZeroDivisionError), replacing(file) as temporary:
        temporary.write_text("half")
        raise ZeroDivisionError
    assert file.read_text() == "first" and os.listdir(tmp_path) == ["table.csv"]


@needs_locks
def test_a_writer_that_died_leaves_nothing_for_long_and_a_living_one_is_left_alone(tmp_path):
    file = tmp_path / "table.csv"
    left = tmp_path / f".table.csv.{TOKEN}.tmp.csv"
    left.write_text("half")
    other = tmp_path / f".other.csv.{TOKEN}.tmp.csv"
    other.write_text("not of this file")
    with replacing(file) as living:
        assert not left.exists() and other.exists()
        living.write_text("first")
        write_text(file, "second")
        assert living.exists()
    assert file.read_text() == "first" and sorted(os.listdir(tmp_path)) == [other.name, "table.csv"]


@pytest.mark.filterwarnings("error::pytest.PytestUnhandledThreadExceptionWarning")
def test_threads_at_one_file(tmp_path):
    texts = [str(n) * 20000 for n in range(8)]
    threads = [threading.Thread(target=lambda text=text: [write_text(tmp_path / "f", text) for _ in range(10)]) for text in texts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (tmp_path / "f").read_text() in texts and [path.name for path in Path(tmp_path).iterdir()] == ["f"]


def test_a_file_that_its_writer_has_made_again_is_no_remnant(tmp_path, monkeypatch):
    """Another process removed the first one, between the moments in which this one opens it and locks it."""
    file, lock = tmp_path / f".f.{16 * '0'}.tmp", atomic.fcntl.flock
    file.write_text("a dead writer's")

    def late(handle, how):
        file.unlink()
        file.write_text("a living writer's")
        lock(handle, how)

    monkeypatch.setattr(atomic.fcntl, "flock", late)
    atomic._remove_unheld(file)
    assert file.read_text() == "a living writer's"
    monkeypatch.setattr(atomic.fcntl, "flock", lock)
    atomic._remove_unheld(file)
    assert not file.exists()


def test_a_full_disk_names_the_file_and_the_folder(tmp_path):
    """The operating system does not, where it is a write that fails."""
    for write in (replacing(tmp_path / "x.csv"), moving.replacing_folder(moving.Place(tmp_path / "run", (), lambda folder: None))):
        with pytest.raises(OSError, match=r"No space left on device: '.*/(x\.csv|run)'"), write:
            raise OSError(errno.ENOSPC, "No space left on device")
    assert not list(tmp_path.iterdir())


def test_a_folder_that_an_export_makes_anew_between_two_renames(tmp_path, monkeypatch):
    """What it put there is in the folder at the end, with what a person had there."""
    monkeypatch.setattr(renames, "_renameat2", lambda: None)
    out = write(tmp_path / "run", "first")
    (out / "notes.txt").write_text("mine")
    rename, done = Path.rename, []

    def between(self, target):
        if ".tmp-" in self.name and Path(target) == out and len(done) < 2:
            done.append(write_text(out / "cad" / f"part{len(done)}.txt", "a part"))
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", between)
    write(out, "second")
    assert len(done) == 2 and texts(out) == {"notes.txt": "mine", "cad/part0.txt": "a part", "cad/part1.txt": "a part"}
    assert os.listdir(tmp_path) == ["run"]


def test_a_file_that_was_not_finished_does_not_come_along(tmp_path, system):
    out = write(tmp_path / "run")
    (out / "cad").mkdir()
    for name in (f".part.txt.{TOKEN}.tmp.txt", ".hidden.txt", "part.tmp.txt"):
        (out / "cad" / name).write_text("some")
    write(out)
    assert sorted(texts(out)) == ["cad/.hidden.txt", "cad/part.tmp.txt"]
