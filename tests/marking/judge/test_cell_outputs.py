import base64
import sysconfig

import pytest

from grader.marking import outputs
from grader.marking.judge import cell_outputs
from grader.marking.judge.cell_outputs import CellOutputs, DisplayRegistry, make_output
from grader.marking.outputs import MAX_CELL_CHARS, TRUNCATED, mime_bundle
from tests.marking.tiny import ROOT


def stream(text: str, name: str = "stdout") -> dict:
    return {"output_type": "stream", "name": name, "text": text}


def picture(text: str) -> dict:
    return {"output_type": "display_data", "data": {"text/plain": text}, "metadata": {}}


def shown(*events: dict, displays: DisplayRegistry | None = None) -> list[dict]:
    cell = CellOutputs(displays or DisplayRegistry())
    for event in events:
        cell.add(event)
    return cell.list


def test_text_of_one_stream_is_one_output():
    events = [stream("a\n"), stream("b\n"), stream("c\n", "stderr"), stream("d\n")]
    assert shown(*({"output": output} for output in events)) == [
        stream("a\nb\n"), stream("c\n", "stderr"), stream("d\n"),
    ]


def test_clear_output_empties_the_cell_at_once_or_with_the_next_output():
    assert shown({"output": stream("a")}, {"clear": False}) == []
    assert shown({"output": stream("a")}, {"clear": True}) == [stream("a")]
    assert shown({"output": stream("a")}, {"clear": True}, {"output": stream("b")}) == [stream("b")]


def test_a_display_is_updated_also_from_a_later_cell():
    displays = DisplayRegistry()
    first = shown({"output": picture("a"), "display_id": "x"}, displays=displays)
    assert shown({"output": picture("b"), "display_id": "x", "update": True}, displays=displays) == []
    assert first == [picture("b")]


def test_an_update_of_nothing_shows_nothing():
    assert shown({"output": picture("b"), "display_id": "x", "update": True}) == []
    assert shown({"output": picture("b"), "display_id": ["x"], "update": True}) == []


def test_a_cell_that_shows_too_much_is_cut_and_says_so_once():
    cell = shown(*[{"output": stream("x" * 300_000)}] * 9)
    assert cell == [stream(cell[0]["text"])]
    assert cell[0]["text"].endswith(TRUNCATED)
    assert cell[0]["text"].count("left out") == 1
    assert len(cell[0]["text"]) < MAX_CELL_CHARS + 100


def test_a_picture_that_is_too_large_is_left_out():
    large, small = picture("x" * MAX_CELL_CHARS), picture("y")
    assert shown({"output": large}, {"output": small}) == [stream(TRUNCATED)]


def test_a_cell_has_not_more_than_a_thousand_outputs():
    cell = shown(*({"output": picture(str(number))} for number in range(2000)))
    assert len(cell) == cell_outputs.MAX_OUTPUTS + 1
    assert cell[-1] == stream(TRUNCATED)


def test_a_cell_that_clears_its_output_may_go_on_for_ever():
    frame = {"output": stream("x" * 400_000)}
    assert shown(*[frame, {"clear": True}] * 50, {"output": stream("end")}) == [stream("end")]


def test_all_cells_together_have_a_limit():
    displays = DisplayRegistry()
    displays.room = 1_500_000
    cells = [shown({"output": stream("x" * 900_000)}, displays=displays) for _ in range(3)]
    assert [round(len(cell[0]["text"]) / 100_000) for cell in cells] == [9, 6, 0]
    assert cells[2] == [stream(TRUNCATED)]


def test_updates_have_the_same_limit():
    displays = DisplayRegistry()
    displays.room = 1000
    first = shown({"output": picture("a"), "display_id": "x"}, displays=displays)
    shown({"output": picture("b" * 5000), "display_id": "x", "update": True}, displays=displays)
    assert first == [picture("a")]


def test_displays_that_were_cleared_are_forgotten():
    displays = DisplayRegistry()
    cell = CellOutputs(displays)
    for number in range(3):
        cell.add({"output": picture(str(number)), "display_id": "x"})
        cell.add({"clear": False})
    assert (displays.room, displays._displays) == (cell_outputs.MAX_SUBMISSION_CHARS, {})


def test_updates_win_no_room():
    displays = DisplayRegistry()
    cell = CellOutputs(displays)
    for _ in range(5):
        cell.add({"output": picture("x" * 900_000), "display_id": "x"})
        cell.add({"output": picture(""), "display_id": "x", "update": True})
        cell.add({"clear": False})
    assert displays.room == cell_outputs.MAX_SUBMISSION_CHARS


def test_updates_can_t_fill_a_cell_beyond_its_limit():
    frames = [{"output": picture(""), "display_id": name} for name in "abc"]
    updates = [{"output": picture("x" * 600_000), "display_id": name, "update": True} for name in "abc"]
    assert [len(output["data"]["text/plain"]) for output in shown(*frames, *updates)] == [600_000, 0, 0]


def test_all_cells_together_have_a_limit_of_outputs():
    displays = DisplayRegistry()
    cells = [CellOutputs(displays) for _ in range(12)]
    for cell in cells:
        for _ in range(995):
            cell.add({"output": picture("p")})
    counts = [len(cell.list) for cell in cells]
    assert (counts[:10], counts[10:]) == ([995] * 10, [51, 1])
    assert cells[-1].list == [stream(TRUNCATED)]
    cells[0].add({"clear": False})
    cells[-1].add({"clear": False})
    cells[-1].add({"output": picture("p")})
    assert cells[-1].list == [picture("p")]


def test_text_with_a_display_id_stays_text():
    update = {"output": picture("p"), "display_id": "x", "update": True}
    assert shown({"output": stream("a"), "display_id": "x"}, update) == [stream("a")]


def test_lines_of_an_error_and_words_of_a_picture_are_limited_and_counted():
    error = make_output({"output_type": "error", "ename": "", "evalue": "", "traceback": [""] * 10_000})
    assert (len(error["traceback"]), outputs.output_size(error)) == (1_000, 50_050)
    words = {"image/png": {"alt": "x" * 10_000, "width": 10**9, "height": True}}
    output = make_output({"output_type": "display_data", "data": {"image/png": ""}, "metadata": words})
    assert (output["metadata"], outputs.output_size(output)) == ({"image/png": {"alt": "x" * 1_000}}, 1_050)


def test_lines_of_the_judge_are_even_in_a_full_cell():
    cell = CellOutputs(DisplayRegistry())
    cell.add({"output": stream("x" * 2 * MAX_CELL_CHARS)})
    cell.add_line("It stopped.")
    assert cell.list[0]["text"].endswith(TRUNCATED + "It stopped.\n")


def test_what_was_written_can_be_had_alone_as_stdout():
    cell = CellOutputs(DisplayRegistry())
    for output in (stream("a"), picture("p"), stream("b", "stderr")):
        cell.add({"output": output})
    assert cell.printed_text == "ab"
    assert CellOutputs(DisplayRegistry()).printed_text == ""


@pytest.mark.parametrize(
    "nonsense",
    [
        None, 3, [], {}, {"output_type": "stream"}, {"output_type": "stream", "name": "out", "text": "x"},
        {"output_type": "stream", "name": "stdout", "text": ["x"]},
        {"output_type": "display_data", "data": "x"},
        {"output_type": "display_data", "data": {"application/javascript": "alert(1)"}},
        {"output_type": "display_data", "data": {"text/html": {"a": 1}}},
        {"output_type": "error", "ename": "E", "evalue": 1, "traceback": []},
        {"output_type": "pyout", "data": {}},
    ],
)  # fmt: skip
def test_what_is_no_output_is_left_out(nonsense):
    assert make_output(nonsense) is None
    assert shown({"output": nonsense}) == []


def test_of_an_output_only_its_own_fields_are_kept():
    claimed = {
        "output_type": "execute_result",
        "execution_count": "7",
        "data": {"text/plain": "x", "application/x-evil": "y", "text/html": ["z"]},
        "metadata": {"image/png": {"width": 5, "height": "6\" onload=", "alt": "a robot"}, "collapsed": True},
        "transient": {},
    }
    assert make_output(claimed) == {
        "output_type": "execute_result",
        "execution_count": None,
        "data": {"text/plain": "x"},
        "metadata": {"image/png": {"width": 5, "alt": "a robot"}},
    }


def test_half_a_character_becomes_a_question_mark():
    assert make_output(stream("\ud83d")) == stream("?")
    error = {"output_type": "error", "ename": "E\ud83d", "evalue": "\udc00", "traceback": ["\ud83d", 5]}
    assert make_output(error) == {"output_type": "error", "ename": "E?", "evalue": "?", "traceback": ["?"]}


def test_bytes_of_pictures_become_base64():
    data = {"image/png": b"\x89PNG", "text/plain": "p", "application/pdf": b"x"}
    assert mime_bundle(data, None) == {"data": {"image/png": "iVBORw==", "text/plain": "p"}, "metadata": {}}


def test_folders_of_the_machine_that_marks_are_not_shown():
    library = f"{sysconfig.get_paths()['purelib']}/rclpy/node.py"
    words = f"{library}:12 and {ROOT}/sim/play.py"
    png = base64.b64encode(words.encode()).decode()
    assert make_output({"output_type": "stream", "name": "stderr", "text": words})["text"] == (
        "rclpy/node.py:12 and sim/play.py"
    )
    error = {"output_type": "error", "ename": "OSError", "evalue": library, "traceback": [library]}
    assert make_output(error)["traceback"] == [make_output(error)["evalue"]] == ["rclpy/node.py"]
    data = {"text/html": f"<b>{library}</b>", "image/png": png}
    assert make_output({"output_type": "display_data", "data": data})["data"] == {
        "text/html": "<b>rclpy/node.py</b>",
        "image/png": png,
    }
