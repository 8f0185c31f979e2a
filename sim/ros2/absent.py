"""Commands, verbs and options of the official `ros2` that are not here, each with what to use instead."""

from __future__ import annotations

# The words after `ros2`, and the end of the sentence "`ros2 ...` is not available here: ...".
COMMANDS = {
    "component": "components are C++ libraries. Use `ros2 run`, or Node in a launch file, instead.",
    "daemon": "each command discovers the nodes by itself. Use `--spin-time` to let it wait longer instead.",
    "extension_points": "no command can be added. Use `ros2 --help` to see those that are here instead.",
    "extensions": "no command can be added. Use `ros2 --help` to see those that are here instead.",
    "multicast": "domains reach no further than this machine. Use `ros2 doctor hello` to test them instead.",
    "plugin": "plugins are C++ libraries. Use `ros2 pkg executables` to see what can be started instead.",
    "security": "nothing here is encrypted. Use a ROS installation for SROS 2 instead.",
    "test": "it needs launch_testing. Use launch_pytest, and `pytest` or `colcon test`, instead.",
    "trace": "it needs LTTng. Use `%ros2 topic hz`, `delay` or plot_jitter() of sim.view instead.",
    "bag burst": "no bag plays message by message. Use `ros2 bag play --rate` with a small rate instead.",
}
_SERVICES = "recorded calls are played as events, on topics. Use `--topics /name/_service_event`"
_ALWAYS_MCAP = "bags are written uncompressed, in one MCAP file. Leave it out"
_NO_KEYS = "there are no keys to press. Use `--rate`, `--start-offset` or Ctrl-C"
_NO_COUNTS = "requests and responses are counted together. Use `ros2 bag info`"
_NO_INFO = "messages are printed alone. Use `ros2 topic delay`, or a callback with MessageInfo,"
_NO_PREFIX = "each program has a prefix of its own. Use `prefix=` of Node in the launch file"
_STDIN = "values are not read from stdin. Write them as an argument"
_SIM_TIME = "it is measured by the clock of this machine. Leave it out"
# Command and verb, and then each option with the reason and what to do, without the end of the sentence.
OPTIONS = {
    "action send_goal": {"--stdin": _STDIN},
    "bag info": {"--verbose": _NO_COUNTS, "-v": _NO_COUNTS},
    "bag play": {
        "--services": _SERVICES,
        "--exclude-services": _SERVICES,
        "--publish-service-requests": "recorded requests are not sent again. Use `ros2 service call`",
        "--service-requests-source": "recorded requests are not sent again. Use `ros2 service call`",
        "--qos-profile-overrides-path": "topics have the QoS that they were recorded with. Leave it out",
        "--storage-config-file": "the format of the bag says how it is read. Leave it out",
        "--clock-topics": "the clock has a frequency. Use `--clock 100`",
        "--clock-topics-all": "the clock has a frequency. Use `--clock 100`",
        "--playback-until-sec": "it ends after a duration. Use `--playback-duration`",
        "--playback-until-nsec": "it ends after a duration. Use `--playback-duration`",
        "--start-paused": _NO_KEYS,
        "-p": _NO_KEYS,
        "--wait-for-all-acked": "it waits for 0.1 s after the last message. Leave it out",
        "--log-level": "it logs nothing. Leave it out",
    },
    "bag record": {
        "--qos-profile-overrides-path": "topics are recorded with the QoS of their publishers. Leave it out",
        "--storage-config-file": _ALWAYS_MCAP,
        "--storage-preset-profile": _ALWAYS_MCAP,
        "--serialization-format": _ALWAYS_MCAP,
        "-f": _ALWAYS_MCAP,
        "--max-bag-size": _ALWAYS_MCAP,
        "-b": _ALWAYS_MCAP,
        "--max-bag-duration": _ALWAYS_MCAP,
        "-d": _ALWAYS_MCAP,
        "--compression-mode": _ALWAYS_MCAP,
        "--compression-format": _ALWAYS_MCAP,
        "--compression-queue-size": _ALWAYS_MCAP,
        "--compression-threads": _ALWAYS_MCAP,
        "--compression-threads-priority": _ALWAYS_MCAP,
        "--snapshot-mode": "each message is written at once. Leave it out",
        "--custom-data": "a bag holds messages only. Write a file beside it",
        "--include-unpublished-topics": "there is nothing to record on them yet. Name them with `--topics`",
        "--ignore-leaf-topics": "topics are recorded by name. Use `--exclude-topics`",
        "--exclude-topic-types": "topics are recorded by name. Use `--exclude-topics`",
        "--exclude-services": "services are recorded by name. Use `--services`",
        "--use-sim-time": _SIM_TIME,
        "--start-paused": _NO_KEYS,
        "--node-name": "the recorder's node is hidden. Leave it out",
        "--log-level": "it logs nothing. Leave it out",
    },
    "doctor": {"--exclude-packages": "no versions of packages are compared. Leave it out"},
    "launch": {"--launch-prefix": _NO_PREFIX, "--launch-prefix-filter": _NO_PREFIX},
    "service call": {"--stdin": _STDIN},
    "topic echo": {"--include-message-info": _NO_INFO, "-i": _NO_INFO},
    "topic pub": {"--stdin": _STDIN, "--use-sim-time": _SIM_TIME, "-s": _SIM_TIME},
    "topic hz": {"--use-sim-time": _SIM_TIME, "-s": _SIM_TIME},
    "topic bw": {"--use-sim-time": _SIM_TIME, "-s": _SIM_TIME},
    "topic delay": {"--use-sim-time": _SIM_TIME, "-s": _SIM_TIME},
}
OPTIONS["doctor"]["-ep"] = OPTIONS["doctor"]["--exclude-packages"]
OPTIONS["wtf"] = OPTIONS["doctor"]


def absent_command(words: str) -> str:
    """The sentence on a command or verb, such as "bag burst", that is not here; "" for any other."""
    return f"`ros2 {words}` is not available here: {COMMANDS[words]}" if words in COMMANDS else ""


def absent_option(words: str, option: str) -> str:
    """The sentence on an option of a command and verb that is not here; "" for any other."""
    option = option.split("=")[0]
    why = OPTIONS.get(words, {}).get(option)
    end = "." if why and why.endswith("Leave it out") else " instead."
    return f"`ros2 {words} {option}` is not available here: {why}{end}" if why else ""
