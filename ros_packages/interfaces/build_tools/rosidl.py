"""Let the rosidl generators read each definition and each template once.

Upstream they read both for each file that they write: nav2_msgs took 41 s of computing, and takes 7 s.
"""

import functools
from collections.abc import Callable


@functools.cache
def read_once() -> None:
    """Keep what the generators read in this process; what they write stays as it was."""
    # The generators are imported where they run: without the ROS wheels, ros_prefix() has the word first.
    import em
    from rosidl_parser import parser

    parser.get_ast_from_idl_string = functools.cache(parser.get_ast_from_idl_string)
    em.Interpreter.parse = _with_known_tokens(em.Interpreter.parse)
    compiled = functools.cache(compile)
    # The two names under which EmPy keeps Python's eval and exec.
    em.evalFunc = lambda code, *scopes: eval(compiled(code.strip(), "<template>", "eval"), *scopes)
    em.execFunc = lambda code, *scopes: exec(compiled(code, "<template>", "exec"), *scopes)


def _with_known_tokens(parse: Callable[..., bool]) -> Callable[..., bool]:
    """Return EmPy's Interpreter.parse, which scans a template for its tokens and runs them, with a memory."""
    from em import Interpreter, Scanner, TransientParseError

    tokens: dict[str, list] = {}

    def parse_once(interpreter: Interpreter, scanner: Scanner, locals: dict | None = None) -> bool:
        text = scanner.buffer
        try:
            if text not in tokens:
                tokens[text] = list(scanner.all())
        except TransientParseError:
            # The text ends within a token; EmPy's own way runs those before it, and asks for more.
            scanner.set(text)
            return parse(interpreter, scanner, locals)
        interpreter.runSeveral(tokens[text], locals)
        return True

    return parse_once
