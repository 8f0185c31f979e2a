"""What of the course a student's process can import, topic by topic, and that what is left works."""

import functools
import importlib
import inspect
import pkgutil
import re
import types

import pytest

import grader
import grader.exercises
from grader.catalog import exercises
from grader.marking.student_process.course_modules import SERVED

TOPICS = [module.name for module in pkgutil.iter_modules(grader.exercises.__path__)]
CLOSED = tuple(f"grader.{name}" for name in ("exercises.", "companions", "geometry", "responses", "worlds",
                                             "marking.judge"))  # fmt: skip
WITH_ANSWERS = [
    module.name
    for module in pkgutil.walk_packages(grader.__path__, "grader.")
    if module.name.startswith(CLOSED)
]
IMPORT_ALL = """
import importlib
for name in {names}:
    try:
        importlib.import_module(name)
    except ModuleNotFoundError:
        continue
    print(name)
"""
EMPTY_GLOBALS = """
import functools, inspect
from grader.exercises import {topic}
for name, value in vars({topic}).items():
    value = value.func if isinstance(value, functools.partial) else value
    owners = [value, *(vars(value).values() if inspect.isclass(value) else [])]
    for function in filter(inspect.isfunction, map(inspect.unwrap, filter(callable, owners))):
        for used in function.__code__.co_names:
            found = function.__globals__.get(used)
            if getattr(found, "__globals__", {{"": 0}}) == {{}}:
                print(name, function, used)
        if "__name__" not in function.__globals__:
            print(name, function)
"""
FUNCTIONS = """
import gc, importlib, types
gc.unfreeze()
for name in {names}:
    try:
        importlib.import_module(name)
    except ModuleNotFoundError:
        continue
for each in gc.get_objects():
    if isinstance(each, types.FunctionType) and str(each.__module__).startswith("grader."):
        print(each.__module__, each.__qualname__)
"""
EVIDENCE = "Recording|Message|Goal|Call|LogLine|Endpoint|Missed|Pose]|Check|Fault|CallbackRun|PackageRun"
# What checks use and a student's process has, although it takes no evidence of a run. Module: names, reason.
THERE = {
    "checks.check": ("Missed fraction hinting tenths", "how a check reports a miss"),
    "checks.ends": ("_a", "words of a miss"),
    "checks.fields": ("_parameters _plain _value listed message_text plain read stamp_words words", "words"),
    "checks.frames": ("Broadcast between", "which transforms were published when"),
    "checks.interface_definitions": ("InterfacePart _form _lines _part _read _reason read_definition",
                                     "reads what a student wrote"),
    "checks.joints": ("JointLimits _cross _filled", "a margin to limits, and points between points"),
    "checks.logs": ("_pace", "the pace of log lines"),
    "checks.mistakes": ("usual_mistake", "compares with wrong formulas"),
    "checks.motion": ("distances_to_line", "how far a path was from a line"),
    "checks.packages": ("_requires_short_output build_warnings hiding imports names_used parsed "
                        "starts_a_node",
                        "reads what a student wrote"),
    "checks.services": ("wrong_response", "words of a miss"),
    "checks.shift": ("Shift _statuses _touched", "counts what was delivered"),
    "checks.topics": ("longest_pause", "a pause between stamps"),
    "checks.twists": ("speeds_text", "words of a miss"),
    "exercises.silence.crash.crash_reports": (
        "CrashReport _constants _is_on_a_robot _lines _name _own_places _place "
        "_report _run crash_reports", "needs the private seed",
    ),
    "exercises.launching.keeper.crates": (
        "crates", "the judge starts these; here they lack all that they use",
    ),
    "exercises.delivery.decide.scripted_orders": (
        "Script ScriptedOrder Situation situations", "needs the private seed",
    ),
    "exercises.silence.doctor.silent_systems": (
        "_misspelt cases", "needs the private seed",
    ),
    "exercises.bags.bag_faults.faulty_bags": (
        "Case draw_case", "needs the private seed",
    ),
    "exercises.bags.bag_report.quiet_lidar": (
        "Drawn draw_bag", "needs the private seed",
    ),
    "exercises.silence.graph.speakers": (
        "QuestionPublisher Speaker plans speakers", "needs the private seed",
    ),
    "companions.map_messages": ("pose_2d", "reads a message"),
    "exercises.localization.localize.scan_matcher": (
        "composed relative", "given: lesson 14c has them, too",
    ),
    "exercises.systems.audit.delays": ("read_delays _ticks", "reads what a student wrote"),
    "exercises.systems.audit.deliveries": ("question_of read_answers", "reads what a student wrote"),
    "exercises.localization.weigh.guesses": ("is_close", "needs the true pose"),
    "exercises.localization.kidnapped.hall": ("trip twin _leg", "needs the private seed"),
    "exercises.localization.kidnapped.log_score": ("log_score", "needs the true pose"),
    "diagnosis.activity": ("_times", "words of a hint"),
    "diagnosis.driving": ("VelocityCommand _command_text", "words of a hint"),
    "geometry.floor": ("away_from points_of", "given: lesson 13 has them, too"),
    "geometry.ground": ("Ground _existing drivable ground shortest", "draws worlds; needs a World"),
    "geometry.near": ("is_near", "compares two numbers"),
    "geometry.occupancy": ("cells_of", "the cells of a grid"),
    "geometry.pose": ("Pose2D", "draws worlds; its two formulas are in lesson 9"),
    "responses.window": ("Window", "times"),
    "workspace.interfaces": ("type_hash", "reads what was built"),
    "exercises.delivery.perceive.crossing": (
        "in_view", "draws worlds; needs a World",
    ),
}
# What earned the points of 6a.1, 6a.4, 11b.3, 12a.1 and 13a.1 when it was handed in.
TRICKS = {
    "navigator": [
        "from grader.exercises.navigator.compass import _bearing, _distance",
        "import grader.geometry.ground",
        "from grader.exercises.delivery import Floor",
    ],
    "launching": [
        "from grader.exercises.launching.patrol.patrol_package import FILES",
        "from grader.exercises.launching.patrol.answers import FILES",
        "from grader.exercises.launching.keeper.crates import INTERFACES",
        "launching.keeper.uses.definitions['msg/Crate.msg']",
    ],
    "safety": [
        "from grader.exercises.safety.mutants.speed_candidates import _right",
        "safety.workshop(1)[0].args",
    ],
    "warehouse": ["from grader.exercises.warehouse.blueprint import TOPICS", "warehouse.blueprint.TOPICS"],
}
ERRORS = "ModuleNotFoundError", "ImportError", "IndexError", "AttributeError", "KeyError"


@pytest.mark.parametrize("topic", TOPICS)
def test_notebooks_import_their_package_and_nothing_else_that_holds_answers(start_student, topic):
    student = start_student(packages=[f"grader.exercises.{topic}"])
    names = student.text(IMPORT_ALL.format(names=WITH_ANSWERS)).split()
    assert names == [*SERVED, f"grader.exercises.{topic}"]
    assert student.text(EMPTY_GLOBALS.format(topic=topic)) == ""
    public = vars(importlib.import_module(names[-1]))
    here = student.text(f"from grader.exercises import {topic}\nprint(*vars({topic}))").split()
    assert [name for name in public if not hasattr(public[name], "__path__") and name not in here] == []


def test_a_companion_that_prepares_a_program_is_in_a_students_process():
    runs = [scenario for exercise in exercises().values() for scenario, _ in exercise.runs()]
    prepares = [one.prepare_for(1) if one.prepare_for else one.prepare for one in runs]
    modules = {getattr(one, "func", one).__module__ for one in prepares if one}
    assert {name for name in modules if name.startswith("grader.companions.")} - {*SERVED} == set()


def used_by(function, found):
    """Add all functions of the grader that a function calls, or may call, and itself."""
    function = inspect.unwrap(function.func if isinstance(function, functools.partial) else function)
    if not str(getattr(function, "__module__", "")).startswith("grader.") or function in found:
        return
    found.add(function)
    if inspect.isclass(function):
        for part in vars(function).values():
            used_by(getattr(part, "fget", None) or getattr(part, "__func__", part), found)
    elif inspect.isfunction(function):
        for name in names_in(function.__code__):
            value = function.__globals__.get(name)
            values = list(value.values()) if isinstance(value, dict) else value
            for part in values if isinstance(values, list | tuple) else [values]:
                used_by(part, found)


def names_in(code):
    """The global names that code uses, with those of functions in it."""
    inner = (each for each in code.co_consts if isinstance(each, types.CodeType))
    return set(code.co_names).union(*map(names_in, inner))


def takes_evidence(function):
    """Whether it measures what is passed to it: a recording, or something of one."""
    parameters = [each for each in inspect.signature(function).parameters.values() if each.name != "self"]
    return bool(parameters) and bool(re.search(EVIDENCE, str(parameters[0].annotation)))


@pytest.mark.parametrize("topic", TOPICS)
def test_no_function_is_there_that_computes_what_a_check_compares_with(start_student, topic):
    start = f"grader.exercises.{topic}"
    modules = [each.name for each in pkgutil.walk_packages(grader.__path__, "grader.")]
    names = [name for name in modules if not name.startswith(("grader.marking", "grader.__main__"))]
    there = start_student(packages=[start]).text(FUNCTIONS.format(names=names)).splitlines()
    used = set()
    for exercise in exercises().values():
        for check in exercise.checks:
            if check.function.__module__.startswith(f"{start}."):
                used_by(check.function, used)
    functions = {each for each in used if inspect.isfunction(each) and not takes_evidence(each)}
    assert functions
    unexpected = {f"{each.__module__} {each.__qualname__}" for each in functions} & set(there)
    for module, (names, _) in THERE.items():
        known = tuple(f"grader.{module} {name}" for name in [*names.split(), "__create_fn__"])
        unexpected -= {name for name in unexpected if name.startswith(known)}
    assert unexpected == set()


@pytest.mark.parametrize("topic", TOPICS)
def test_classes_that_stay_with_the_judge_have_no_methods_there(start_student, topic):
    student = start_student(packages=[f"grader.exercises.{topic}"])
    there = student.text(FUNCTIONS.format(names=[])).splitlines()
    homes = {line.partition(" ")[0] for line in there if line.startswith(CLOSED) and "<lambda>" not in line}
    assert not {"grader.exercises.navigator.compass", "grader.exercises.sensing.sectors.scan_sectors"} & homes
    assert ("grader.geometry.floor" in homes) == (topic == "delivery")


@pytest.mark.parametrize("topic", TRICKS)
def test_right_functions_and_reference_data_are_not_there(start_student, topic):
    student = start_student(packages=[f"grader.exercises.{topic}"])
    for trick in TRICKS[topic]:
        (output,) = student.run(f"from grader.exercises import {topic}\n{trick}")
        assert output["ename"] in ERRORS, trick


def test_an_import_that_is_refused_says_what_can_be_imported(start_student):
    (output,) = start_student(packages=["grader.exercises.topics"]).run("import grader.exercises.safety")
    assert output["evalue"] == (
        "No module named 'grader.exercises.safety' when a class is marked: from the grader, "
        "notebooks can import grader and grader.exercises.topics"
    )


def test_exercises_have_no_checks_and_grade_nothing_in_a_cell_that_is_no_test(start_student):
    student = start_student(packages=["grader.exercises.topics"])
    student.run("from grader.exercises import topics\nfrom grader import catalog")
    checks = student.text("print([each.checks for each in catalog.exercises().values() if each.checks])")
    assert checks == "[]\n"
    text = "Not graded here: when a class is marked, the test cells are.\n"
    assert student.text("_ = topics.square.grade(int)") == text
