"""The names of upstream's that are not supported; each is refused in one sentence."""

from collections.abc import Iterable
from typing import NoReturn

LEFT_OUT = {
    "launch.actions": (
        "AppendEnvironmentVariable ExecuteLocal OpaqueCoroutine PopEnvironment PopLaunchConfigurations "
        "PushEnvironment PushLaunchConfigurations ResetEnvironment ResetLaunchConfigurations "
        "UnregisterEventHandler UnsetEnvironmentVariable UnsetLaunchConfiguration"
    ),
    "launch.conditions": "LaunchConfigurationEquals LaunchConfigurationNotEquals",
    "launch.event_handlers": "OnIncludeLaunchDescription event_named",
    "launch.launch_description_sources": (
        "FrontendLaunchDescriptionSource InvalidFrontendLaunchFileError "
        "get_launch_description_from_frontend_launch_file"
    ),
    "launch.substitutions": (
        "AllSubstitution AndSubstitution AnonName AnySubstitution FileContent IfElseSubstitution "
        "LaunchLogDir NotSubstitution OrSubstitution ThisLaunchFile"
    ),
    "launch_ros.actions": (
        "ComposableNodeContainer LoadComposableNodes ROSTimer RosTimer SetParametersFromFile SetROSLogDir "
        "SetUseSimTime"
    ),
    "launch_ros.descriptions": "ComposableNode Parameter",
    "launch_ros.substitutions": "Parameter",
}


def refuse(module: str, name: str, known: Iterable[str]) -> NoReturn:
    """Raise ImportError for a name that upstream has, AttributeError for any other."""
    if name in LEFT_OUT.get(module, "").split():
        there = ", ".join(sorted(known))
        raise ImportError(f"{module}.{name} is not supported by this course's launch, which has {there}.")
    raise AttributeError(f"module {module!r} has no attribute {name!r}")
