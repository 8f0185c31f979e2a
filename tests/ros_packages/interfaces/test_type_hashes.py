"""The types are upstream's: nodes of a real robot talk to nodes that use them."""

import json

import pytest
import type_hashes
from build_tools.toolchain import ros_prefix

SHARE = ros_prefix() / "share"
# std_msgs and std_srvs come from upstream's wheels and hold the same messages under another package name.
TWINS = [
    (f"example_interfaces/{kind}/{file.stem}", f"{package}/{kind}/{file.stem}")
    for package, kind in (("std_msgs", "msg"), ("std_srvs", "srv"))
    for file in sorted(SHARE.glob(f"{package}/{kind}/*.json"))
    if (SHARE / "example_interfaces" / kind / file.name).exists()
]


def description(name: str) -> dict[str, object]:
    """{type name: fields} of an interface and all that it uses, with its package's name taken out."""
    package = name.split("/")[0]
    text = (SHARE / f"{name}.json").read_text(encoding="utf-8").replace(f'"{package}/', '"package/')
    described = json.loads(text)["type_description_msg"]
    types = [described["type_description"], *described["referenced_type_descriptions"]]
    return {each["type_name"]: each["fields"] for each in types}


@pytest.mark.parametrize(("name", "wanted"), sorted(type_hashes.upstream().items()))
def test_the_hash_is_the_one_upstream_published(name, wanted):
    assert type_hashes.installed()[name] == wanted


@pytest.mark.parametrize(("name", "twin"), TWINS)
def test_an_example_message_has_the_fields_of_its_twin_in_upstreams_wheels(name, twin):
    assert description(name) == description(twin)


def test_all_plain_messages_have_a_twin():
    assert len(TWINS) == 30


def test_the_command_prints_every_hash_and_says_which_are_upstreams(capsys, definitions):
    assert type_hashes.main() == 0
    lines = [line.split("  ") for line in capsys.readouterr().out.splitlines()]
    printed = {name: found for name, found, _ in lines}
    assert printed.items() <= type_hashes.installed().items()
    assert {str(file.relative_to(definitions).with_suffix("")) for file in definitions.glob("*/*/*")} <= set(
        printed
    )
    assert {name for name, _, verdict in lines if verdict == "as upstream"} == set(type_hashes.upstream())
    with capsys.disabled():
        print("\nNo upstream hash is known for these:")
        print("\n".join(f"  {name} {found}" for name, found, verdict in lines if verdict != "as upstream"))


def test_the_command_fails_and_names_both_hashes_where_one_differs(capsys, monkeypatch):
    found = type_hashes.installed()["tf2_msgs/msg/TFMessage"]
    monkeypatch.setattr(type_hashes, "upstream", lambda: {"tf2_msgs/msg/TFMessage": "RIHS01_00"})
    assert type_hashes.main() == 1
    assert f"tf2_msgs/msg/TFMessage  {found}  upstream has RIHS01_00\n" in capsys.readouterr().out


def test_the_command_fails_where_a_recorded_type_is_not_installed(monkeypatch):
    monkeypatch.setattr(type_hashes, "upstream", lambda: {"tf2_msgs/msg/Gone": "RIHS01_00"})
    assert type_hashes.main() == 1
