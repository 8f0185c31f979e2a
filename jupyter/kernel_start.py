"""Runs at the start of every kernel of `make lab`: explains undefined names and missing modules.

A cell that uses rclpy finds `sim` imported, so that a spin outside a run can't block the kernel.
"""


def _explain_missing_names() -> None:
    import builtins

    def explain(shell, kind, error, trace, tb_offset=None):
        from sim.notebook import show_error  # imported here because it is slow

        show_error(shell, kind, error, trace, tb_offset)

    if hasattr(builtins, "get_ipython"):
        builtins.get_ipython().set_custom_exc((NameError, ModuleNotFoundError), explain)


def _import_sim_before_rclpy() -> None:
    import builtins
    import sys

    shell = getattr(builtins, "get_ipython", lambda: None)()

    def before(info):
        if "rclpy" in (info.raw_cell or "") and "sim" not in sys.modules:
            with shell.builtin_trap:  # get_ipython() is there in cells only
                import sim  # noqa: F401
        if "sim" in sys.modules:
            shell.events.unregister("pre_run_cell", before)

    if shell is not None:
        shell.events.register("pre_run_cell", before)


_explain_missing_names()
_import_sim_before_rclpy()
del _explain_missing_names, _import_sim_before_rclpy
