"""ros2 bag: record messages, print information about a bag, copy and repair it."""

from __future__ import annotations

import time
from argparse import Namespace
from pathlib import Path

import yaml

from sim.nanoseconds import SECOND
from sim.ros.bags.bag_files import Bag, BagWriter, write_metadata
from sim.ros.bags.contents import MCAP, SQLITE
from sim.ros2.group import Group, argument, flag
from sim.ros2.interface_types import installed_type
from sim.ros2.system import CliError, Output, System, suggestion
from sim.ros2.topic_selection import SELECTING, TopicSelection

bag = Group("bag", "Bags: record messages, inspect them, play them back")
PATH = argument("bag_path", type=Path, help="The folder of a bag, or an .mcap file")
STORAGE = argument("-s", "--storage", choices=[MCAP], default=MCAP, help="The format to write: mcap")
READ_STORAGE = argument("-s", "--storage", choices=[MCAP, SQLITE], help="Changes nothing: it is recognized")


@bag.verb(
    "record",
    *SELECTING,
    argument("-o", "--output", type=Path, help="The folder to make; by default it is named by the time"),
    STORAGE,
    flag("--no-discovery", help="Only topics present at startup will be recorded"),
    argument("-p", "--polling-interval", type=int, default=100, help="Changes nothing: it checks often"),
    argument("--max-cache-size", type=int, help="Changes nothing: each message is written at once"),
    flag("--disable-keyboard-controls", help="Changes nothing: there are none"),
)
def record(system: System, options: Namespace) -> None:
    """Record ROS data to a bag."""
    options.all_topics |= options.all
    options.all_services |= options.all
    options.topics = [*options.topics, *options.topics_positional]
    selection = TopicSelection.of(options)
    if selection.is_empty:
        raise CliError(
            "Need to specify at least one option out of --all, --all-topics, --all-services, --services, "
            "--topics, --topic-types or --regex"
        )
    chosen = _chosen(system, selection, wait=not options.no_discovery)
    if not chosen:
        raise CliError("There is nothing to record.")
    qos = {end.name: end.qos for end in system.endpoints if end.kind == "publisher"}
    folder = options.output or Path(time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    with system.uninterrupted() as interrupts, BagWriter(folder) as writer:
        for name in chosen:
            system.print_line(f"Subscribed to topic '{name}'")
        try:
            for message in system.subscribe(chosen):
                if message is not None:
                    at, sent = (system.epoch + round(s * SECOND) for s in (message.stamp, message.sent))
                    offered = qos.get(message.topic, {})
                    writer.write(message.topic, message.type, message.raw, (at, sent), offered)
                elif interrupts:
                    break
        finally:
            system.print_line(f"Recording stopped: {writer.contents.counts.total()} messages in {folder}")


def _chosen(system: System, selection: TopicSelection, *, wait: bool) -> dict[str, str]:
    """The selected topics and their types. wait: until all that are named are there."""
    known = system.topics(hidden=True)
    for name in selection.names:
        if name not in known:
            system.print_line(
                f"WARNING: topic [{name}] does not appear to be published yet{suggestion(name, known)}"
            )
    if wait and system.time_limit is None and not system.finished:
        for _ in system.subscribe({}):
            known = system.topics(hidden=True)
            if known.keys() >= set(selection.names):
                break
    found = {name: types[0] for name, types in known.items() if selection.includes(name, types[0])}
    return {name: installed_type(type_) for name, type_ in found.items()}


@bag.verb(
    "info",
    PATH,
    READ_STORAGE,
    flag("-t", "--topic-name", help="Only display topic names."),
    without_system=True,
)
def info(output: Output, options: Namespace) -> None:
    """Print information about a bag to the screen."""
    bag_ = Bag(options.bag_path)
    if options.topic_name:
        for name in bag_.contents.topics:
            output.print_line(name)
    else:
        output.print_line(bag_.info())


@bag.verb(
    "list",
    argument(
        "plugin_type",
        choices=["storage", "converter", "compressor", "decompressor"],
        help="lists available plugins",
    ),
    flag("-v", "--verbose", help="output verbose information about the available plugin"),
    without_system=True,
)
def list_(output: Output, options: Namespace) -> None:
    """Print information about available plugins to the screen."""
    if options.verbose:
        output.print_line(f"available {options.plugin_type} plugins are:")
    if options.plugin_type == "storage":
        output.print_line(f"{'name: ' if options.verbose else ''}mcap")
        if options.verbose:
            output.print_line("\tReads and writes MCAP files, with the libraries mcap and PyYAML")


@bag.verb("reindex", PATH, STORAGE, without_system=True)
def reindex(output: Output, options: Namespace) -> None:
    """Reconstruct metadata file for a bag."""
    if not options.bag_path.is_dir():
        raise CliError("Must specify a bag directory")
    output.print_line(f"Beginning reindexing bag in directory: {options.bag_path}")
    bag_ = Bag(options.bag_path)
    write_metadata(options.bag_path, bag_.contents, bag_.files)
    output.print_line("Reindexing complete.")


# Keys of an output bag, what each asks for, and the values that change nothing.
REFUSED = {
    "compression_mode": ("compressed", ("none",)),
    "storage_id": ("in another format than mcap", ("mcap",)),
    "max_bagfile_size": ("split into several files", (0,)),
    "max_bagfile_duration": ("split into several files", (0,)),
}
EXAMPLE = "output_bags: [{uri: new_bag, all_topics: true}]"


@bag.verb(
    "convert",
    argument(
        "-i",
        "--input",
        required=True,
        action="append",
        nargs="+",
        metavar=("uri", "storage_id"),
        help="An input bag. May be provided more than once",
    ),
    argument("-o", "--output-options", type=Path, required=True, help="YAML file with the output bags"),
    without_system=True,
)
def convert(output: Output, options: Namespace) -> None:
    """Given an input bag, write out a new bag with different settings."""
    for words in options.input:
        if len(words) > 2 or words[1:] not in ([], [MCAP], [SQLITE]):
            raise CliError(
                f"--input expects a bag and, at most, its format, {MCAP} or {SQLITE}; it has "
                f"{' '.join(words)}."
            )
    bags = [Bag(Path(words[0])) for words in options.input]
    found = [item for each in bags for item in each.messages()]
    found.sort(key=lambda item: item[2].log_time)
    for uri, selection in _outputs(options.output_options):
        with BagWriter(uri) as writer:
            for schema, channel, message in found:
                if selection.includes(channel.topic, schema.name):
                    times = message.log_time, message.publish_time
                    writer.add(channel.topic, schema.name, message.data, times, channel.metadata)


def _outputs(file: Path) -> list[tuple[Path, TopicSelection]]:
    """The folder of each output bag in a file, and what is copied there. Raises CliError."""
    try:
        content = yaml.safe_load(file.read_text())
    except OSError as error:
        raise CliError(f"{file} can't be read: {error.strerror}.") from None
    except yaml.YAMLError as error:
        raise CliError(f"{file} is not YAML: {error}") from None
    outputs = content.get("output_bags") if isinstance(content, dict) else None
    if not (isinstance(outputs, list) and all(isinstance(it, dict) and it.get("uri") for it in outputs)):
        raise CliError(f"{file} has no list of output_bags, each with a uri, such as {EXAMPLE}.")
    for each in outputs:
        for key, (what, values) in REFUSED.items():
            if each.get(key) not in (None, "", *values):
                raise CliError(f"{file}: {each['uri']} can't be {what} here: leave out {key}.")
    return [(Path(each["uri"]), TopicSelection.of(each)) for each in outputs]
