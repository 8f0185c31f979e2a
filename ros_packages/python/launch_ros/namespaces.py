"""Names and namespaces of nodes: joins and validates them."""

from __future__ import annotations

NAMESPACE = "ros_namespace"  # the launch configuration that all nodes read


def join_namespaces(base: str | None, namespace: str | None) -> str | None:
    """A namespace inside another one, unless it begins with a slash; absolute. None if both are None."""
    if namespace is None:
        found = base
    elif namespace.startswith("/") or not base:
        found = namespace
    else:
        found = f"{base.rstrip('/')}/{namespace}"
    if found is None:
        return None
    found = found if found == "/" else found.rstrip("/")
    return found if found.startswith("/") else f"/{found}"


def validate_name(name: str) -> None:
    """Raise InvalidNodeNameException for a name that no node can have."""
    from rclpy.validate_node_name import validate_node_name

    validate_node_name(name)


def validate_namespace(namespace: str) -> None:
    """Raise InvalidNamespaceException for a namespace that no node can have."""
    from rclpy.validate_namespace import validate_namespace

    validate_namespace(namespace)
