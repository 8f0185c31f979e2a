"""Which topics of a system or a bag are recorded, played or copied."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

from sim.ros.bags.contents import EVENTS, is_service_event
from sim.ros2.group import argument, flag
from sim.ros2.system import CliError, is_hidden


@dataclass
class TopicSelection:
    """A selection by the official options of the same names. Raises CliError for an invalid expression."""

    all_topics: bool = False
    all_services: bool = False
    topics: Sequence[str] = ()
    services: Sequence[str] = ()
    topic_types: Sequence[str] = ()
    regex: str = ""
    exclude_regex: str = ""
    exclude_topics: Sequence[str] = ()
    include_hidden_topics: bool = False

    def __post_init__(self) -> None:
        for expression in (self.regex, self.exclude_regex):
            try:
                re.compile(expression)
            except re.error as error:
                raise CliError(f"{expression!r} is not a regular expression: {error}.") from None

    @classmethod
    def of(cls, options: Namespace | dict[str, Any]) -> TopicSelection:
        """Return the selection by a command's options, or by the dictionary of a YAML file."""
        given = vars(options) if isinstance(options, Namespace) else options
        return cls(**{each.name: given[each.name] for each in fields(cls) if given.get(each.name)})

    @property
    def is_empty(self) -> bool:
        """Return whether it selects nothing, whatever there is."""
        whole = self.all_topics or self.all_services
        return not (whole or self.topics or self.services or self.topic_types or self.regex)

    @property
    def names(self) -> list[str]:
        """The topics that it names."""
        return [*self.topics, *(f"{service}{EVENTS}" for service in self.services)]

    def includes(self, topic: str, type_: str) -> bool:
        """Return whether it selects this topic."""
        if topic in self.exclude_topics or (self.exclude_regex and re.search(self.exclude_regex, topic)):
            return False
        if is_service_event(topic, type_):
            whole = self.all_services
        else:
            whole = self.all_topics and (self.include_hidden_topics or not is_hidden(topic))
        by_name = topic in self.names or type_ in self.topic_types
        return whole or by_name or bool(self.regex and re.search(self.regex, topic))


EXCLUDING = (
    argument("-e", "--regex", default="", help="Topics and services that contain this regular expression"),
    argument("--exclude-topics", nargs="+", default=[], metavar="TOPIC", help="Topics to leave out"),
)
SELECTING = (
    argument("topics_positional", nargs="*", metavar="TOPIC", help="Topics to record"),
    argument("--topics", nargs="+", default=[], metavar="TOPIC", help="Topics to record"),
    argument("--services", nargs="+", default=[], metavar="SERVICE", help="Services to record"),
    argument("--topic-types", nargs="+", default=[], metavar="TYPE", help="Types of topics to record"),
    flag("-a", "--all", help="Record all topics and services"),
    flag("--all-topics", help="Record all topics"),
    flag("--all-services", help="Record the events of all services"),
    *EXCLUDING,
    argument("--exclude-regex", default="", help="Leave out what contains this regular expression"),
    flag("--include-hidden-topics", help="Record hidden topics as well"),
)
