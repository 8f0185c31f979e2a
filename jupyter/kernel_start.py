"""Runs at the start of every kernel of `make lab`: explains undefined names and missing modules.

A cell that uses rclpy finds `sim` imported, so that a spin outside a run can't block the kernel. A cell that
prints without end doesn't overload the page.
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


def _limit_output() -> None:
    import builtins
    import importlib.util
    from pathlib import Path

    if not hasattr(builtins, "get_ipython"):
        return
    sim = Path(importlib.util.find_spec("sim").origin).parent  # not imported here because it is slow
    spec = importlib.util.spec_from_file_location("output_limit", sim / "notebook" / "output_limit.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.limit_output(builtins.get_ipython())


_explain_missing_names()
_import_sim_before_rclpy()
_limit_output()
del _explain_missing_names, _import_sim_before_rclpy, _limit_output
