import io
import logging
import os
import sys

import pytest

from grader.stderr_redirect import LIMIT, redirect_stderr


def test_output_of_python_of_c_and_of_old_handlers_goes_to_stdout(capfd):
    handler = logging.StreamHandler(sys.stderr)
    with redirect_stderr():
        print("python", file=sys.stderr)
        os.write(2, b"descriptor\n")
        handler.emit(logging.makeLogRecord({"msg": "handler"}))
    said = capfd.readouterr()
    assert said.err == ""
    assert [word for word in ("python", "descriptor", "handler") if word not in said.out] == []


def test_silence_prints_nothing(capfd):
    with redirect_stderr():
        pass
    assert capfd.readouterr() == ("", "")


def test_afterwards_all_is_as_before(capfd):
    before = sys.stderr
    with redirect_stderr(), redirect_stderr():
        pass
    assert sys.stderr is before
    assert "write" not in vars(before)
    print("python", file=sys.stderr)
    os.write(2, b"descriptor\n")
    assert capfd.readouterr() == ("", "python\ndescriptor\n")


def test_a_stream_that_was_changed_already_stays_so(monkeypatch):
    caught = []
    stream = io.StringIO()
    stream.write = caught.append
    monkeypatch.setattr(sys, "stderr", stream)
    with redirect_stderr():
        stream.write("within")
    stream.write("after")
    assert caught == ["after"]


def test_it_works_where_there_is_no_stderr(monkeypatch, capfd):
    monkeypatch.setattr(sys, "stderr", None)
    with redirect_stderr():
        os.write(2, b"descriptor\n")
    assert capfd.readouterr() == ("descriptor\n\n", "")


def test_captured_text_is_printed_even_if_the_block_raises(capfd):
    with pytest.raises(KeyboardInterrupt), redirect_stderr():
        print("last words", file=sys.stderr)
        raise KeyboardInterrupt
    assert capfd.readouterr().out == "last words\n\n"


def test_a_flood_is_cut(capfd):
    with redirect_stderr():
        os.write(2, b"x" * (LIMIT + 1))
    assert capfd.readouterr().out == "x" * LIMIT + "\n... and so on\n"
