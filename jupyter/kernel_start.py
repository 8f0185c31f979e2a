"""Runs at the start of every kernel of `make lab`: explains undefined names, even before any import."""


def _explain_missing_names() -> None:
    import builtins

    def explain(shell, kind, error, trace, tb_offset=None):
        from sim.notebook import show_error  # imported here because it is slow

        show_error(shell, kind, error, trace, tb_offset)

    if hasattr(builtins, "get_ipython"):
        builtins.get_ipython().set_custom_exc((NameError,), explain)


_explain_missing_names()
del _explain_missing_names
