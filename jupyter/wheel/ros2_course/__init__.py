"""The command ros2-course; in an installed wheel also what students get beside Python's packages."""
