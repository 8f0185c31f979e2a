# The linters that this package would look for are not installed: there are no tests to add.
set(ament_lint_auto_FOUND_AMENT_PACKAGE TRUE)

macro(ament_lint_auto_find_test_dependencies)
endmacro()
