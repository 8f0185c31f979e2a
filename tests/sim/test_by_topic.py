"""The messages of a topic, asked for again and again while a run goes on."""

import pickle

from sim.evidence import Message
from sim.evidence.by_topic import ByTopic

SENT = [
    Message(number / 10, f"/topic{number % 3}", "std_msgs/msg/Empty", "/node", b"") for number in range(30)
]
OF_TOPIC_2 = SENT[2::3]


def test_a_list_that_grows_is_gone_on_with():
    by_topic, received = ByTopic(), []
    assert by_topic.of(received, "/topic2") == []
    for message in SENT:
        received.append(message)
        assert by_topic.of(received, "/topic2") == [it for it in received if it.topic == "/topic2"]
    assert by_topic.of(received, "/none") == []


def test_what_was_given_is_a_list_of_its_own():
    by_topic = ByTopic()
    by_topic.of(SENT, "/topic2").clear()
    assert by_topic.of(SENT, "/topic2") == OF_TOPIC_2


def test_a_list_that_was_changed_is_looked_at_anew():
    by_topic, received = ByTopic(), list(SENT)
    assert by_topic.of(received, "/topic2") == OF_TOPIC_2
    received[:] = [message._replace(topic="/topic2") for message in received]
    assert by_topic.of(received, "/topic2") == received
    del received[10:]
    assert by_topic.of(received, "/topic2") == received
    received.clear()
    assert by_topic.of(received, "/topic2") == []
    assert by_topic.of(SENT, "/topic2") == OF_TOPIC_2


def test_a_copy_finds_the_same():
    by_topic = ByTopic()
    assert by_topic.of(SENT, "/topic2") == pickle.loads(pickle.dumps(by_topic)).of(SENT, "/topic2")
