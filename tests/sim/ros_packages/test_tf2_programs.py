"""tf2_ros' programs, as tutorials start them: static_transform_publisher and tf2_echo."""

import pytest

from sim import Process, executable, run

WORLD_TO_CAM = "--frame-id world --child-frame-id cam"
ECHOED = """\
At time 0.0
- Translation: [1.000, 0.000, 0.500]
- Rotation: in Quaternion [0.000, 0.000, 0.707, 0.707]
- Rotation: in RPY (radian) [0.000, 0.000, 1.571]
- Rotation: in RPY (degree) [0.000, 0.000, 90.000]
- Matrix:
  0.000 -1.000  0.000  1.000
  1.000  0.000  0.000  0.000
  0.000  0.000  1.000  0.500
  0.000  0.000  0.000  1.000
"""


def program(name, words):
    return Process(executable("tf2_ros", name), arguments=words.split())


def publisher(words):
    return program("static_transform_publisher", words)


def printed(recording):
    return "".join(text for _, text in recording.prints)


@pytest.mark.parametrize(
    "words",
    [
        f"--x 1 --z 0.5 --yaw 1.5707963267948966 {WORLD_TO_CAM}",
        f"--x 1 --z 0.5 --qz 0.7071067811865476 --qw 0.7071067811865476 {WORLD_TO_CAM}",
        "1 0 0.5 1.5707963267948966 0 0 world cam",
        "1 0 0.5 0 0 0.7071067811865476 0.7071067811865476 world cam",
    ],
)
def test_what_one_tells_the_other_prints(words):
    recording = run(publisher(words), program("tf2_echo", "world cam 2"), seconds=1.2, quiet=True)
    assert printed(recording) == 2 * ECHOED
    (line,) = recording.logs
    assert line.text == (
        "Spinning until stopped - publishing transform\n"
        "translation: ('1.000000', '0.000000', '0.500000')\n"
        "rotation: ('0.000000', '0.000000', '0.707107', '0.707107')\n"
        "from 'world' to 'cam'"
    )


def test_a_frame_without_a_publisher_is_waited_for():
    recording = run(program("tf2_echo", "world cam"), seconds=1, quiet=True)
    assert [line.text.strip() for line in recording.logs] == [
        'Waiting for transform world ->  cam: "world" passed to lookupTransform argument target_frame'
        " does not exist."
    ]


@pytest.mark.parametrize(
    ("name", "arguments", "text"),
    [
        ("tf2_echo", "world", "Usage: tf2_echo source_frame target_frame [echo_rate]\n"),
        ("tf2_echo", "world cam x", "Failed to convert rate argument 'x' to a floating-point number\n"),
        (
            "static_transform_publisher",
            f"--yaw 1 --qw 1 {WORLD_TO_CAM}",
            "static_transform_publisher: error: Cannot mix euler angles and quaternions\n",
        ),
        (
            "static_transform_publisher",
            "--frame-id world",
            "static_transform_publisher: error: the following arguments are required: --child-frame-id\n",
        ),
    ],
)
def test_invalid_arguments_are_named(name, arguments, text, capsys):
    run(program(name, arguments), seconds=1)
    out, err = capsys.readouterr()
    assert text in out + err
