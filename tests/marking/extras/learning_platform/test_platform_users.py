"""Matching people of a file with students."""
import pytest

from grader.marking.extras.learning_platform.platform_users import KnownStudent, PlatformUser, match_users

ANNA = KnownStudent("anna", "Anna", "Meier", "anna@example.org")
OTHER = KnownStudent("am2", "Anna", "Meier", "other@example.org")
BOB = KnownStudent("1234567", "Bob", "O'Hara", numbers=frozenset({"77"}))


@pytest.mark.parametrize(
    ("person", "student"),
    [
        (PlatformUser("?", ids=("anna",)), "anna"),
        (PlatformUser("?", ids=("ANNA@Example.org ",)), "anna"),
        (PlatformUser("Anna Meier"), "anna"),
        (PlatformUser("Meier, Anna"), "anna"),
        (PlatformUser("meieranna"), "anna"),
        (PlatformUser("\u202bAnna Meier\u202c"), "anna"),
        (PlatformUser("Anna Meier", ids=("else@example.org",)), None),  # another person with this name
        (PlatformUser("Ann Meier"), None),
        (PlatformUser("?", "77"), "1234567"),
        (PlatformUser("?", "1234567"), None),  # a participant's number is no id
        (PlatformUser("Bob O`Hara"), "1234567"),
        (PlatformUser("Bob O'Hara", "78"), None),  # his number is known, and is another one
        (PlatformUser("", ids=("", " ")), None),
    ],
)
def test_one_person_is_found_by_number_id_mail_or_name(person, student):
    found = match_users([person], [ANNA, BOB]).found
    assert found == ({0: student} if student else {})


def test_what_two_have_decides_nothing():
    by_name = match_users([PlatformUser("Anna Meier")], [ANNA, OTHER])
    assert (by_name.found, by_name.ambiguous) == ({}, {0: ["am2", "anna"]})
    twice = match_users([PlatformUser("Anna Meier"), PlatformUser("Meier, Anna")], [ANNA])
    assert (twice.found, twice.ambiguous) == ({}, {0: ["anna"], 1: ["anna"]})
    same_mail = match_users([PlatformUser("A", ids=("anna",)), PlatformUser("B", ids=("anna@example.org",))], [ANNA])
    assert (same_mail.found, same_mail.ambiguous) == ({}, {0: ["anna"], 1: ["anna"]})


def test_a_stronger_key_comes_first_and_leaves_the_rest_to_the_weaker():
    people = [PlatformUser("Anna Meier"), PlatformUser("Anna Meier", ids=("other@example.org",))]
    assert match_users(people, [ANNA, OTHER]).found == {0: "anna", 1: "am2"}


def test_umlauts_agree_however_they_are_composed():
    student = KnownStudent("m", "Jürgen", "Müller")
    assert match_users([PlatformUser("Mu\u0308ller, Ju\u0308rgen")], [student]).found == {0: "m"}


def test_a_label_has_what_identifies_a_person():
    assert PlatformUser("Anna", "7", ("x", "a@b.org")).label == "Anna (7, a@b.org)"
    assert PlatformUser("Anna", "", ("x", "y")).label == "Anna (x)"
    assert PlatformUser("Anna").label == "Anna"
