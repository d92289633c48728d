"""Inner functions compiled once, as parts of the kernels that call them.

Numba optimizes and assembles every function by itself before it links it to its callers, where the
same is done to it again, up the whole tree of calls, which more than doubles the time of a first
run. Here the code of an inner function is only kept, to be linked to a kernel and optimized there.
"""

from __future__ import annotations

import gc
import operator
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from llvmlite.binding import Linkage
from numba import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import cpu_target
from numba.core.typed_passes import NativeLowering

from pdtheory.pointset.kernels.lowering import PlainLowering

F = TypeVar("F", bound=Callable[..., Any])

#: What makes of its arguments' types always the same.
_OPERATORS = frozenset(
    {bool, int, min, max, abs, *(value for value in vars(operator).values() if callable(value))}
)

#: What Numba goes through for features that no kernel uses: closures, inlined functions, rewritten
#: expressions of arrays, loops over tuples, exceptions with values, listings with types.
NEEDLESS = frozenset(
    {
        "with_lifting",
        "inline_closure_likes",
        "Rewrite dynamic raises",
        "make_function_op_code_to_jit_function",
        "inline_inlinables",
        "find_literally",
        "literal_unroll",
        "LiteralPropagation",
        "inline_overloads",
        "nopython_rewrites",
        "nopython_supported_feature_validation",
        "annotate_types",
    }
)


class Pipeline(CompilerBase):
    """The passes that kernels need."""

    def define_pipelines(self) -> list[Any]:
        """Return the one way to compile."""
        manager = DefaultPassBuilder.define_nopython_pipeline(self.state)
        manager.passes = [
            (PlainLowering if one is NativeLowering else one, text)
            for one, text in manager.passes
            if one._name not in NEEDLESS
        ]
        manager.finalize()
        return [manager]


class _Unset:
    """The code generator as an inner function sees it, which is no part of the process yet."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def __getattr__(self, name: str) -> Any:
        return getattr(self._codegen, name)

    def set_env(self, env_name: str, env: Any) -> None:
        """Do nothing: only code that needs the interpreter has an environment."""


class Part(JITCodeLibrary):
    """Code that waits to be linked."""

    @property
    def codegen(self) -> Any:
        """The code generator."""
        return _Unset(self._codegen)

    def add_llvm_module(self, ll_module: Any) -> None:
        """Take the code of a function as it is."""
        ll_module.data_layout = self._codegen._data_layout
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Let every kernel have a copy of the functions, for it to drop once they are inlined."""
        self._raise_if_finalized()
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == Linkage.external:
                function.linkage = "linkonce_odr"
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """There is none."""
        return 0

    def _get_module_for_linking(self) -> Any:
        # A function of others needs all of it: Numba shares what it compiles, such as `min`.
        if self._shared_module is None:
            for library in self._linking_libraries:
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        return super()._get_module_for_linking()


class Whole(JITCodeLibrary):
    """Code of a kernel, with all its parts."""

    _linking_libraries: list[Any]

    def _optimize_final_module(self) -> None:
        # Numba does that twice, cheaply at first, to find counts of references that cancel.
        found = self._codegen._module_pass_manager()
        passes, *builder = found if isinstance(found, tuple) else (found,)
        passes.run(self._final_module, *builder)

    def finalize(self) -> None:
        """Link the parts and make machine code of the whole."""
        found: dict[Any, None] = {}
        waiting: list[Any] = list(self._linking_libraries)
        while waiting:
            library = waiting.pop()
            if library not in found:
                found[library] = None
                if isinstance(library, Part):
                    waiting += library._linking_libraries
        for library in found:
            if isinstance(library, Part):
                # What a library does when it is loaded; Numba has it since 0.63.
                if hasattr(self, "_reload_init"):
                    self._reload_init.update(library._reload_init)
                self._final_module.link_in(library._final_module, preserve=True)
        self._linking_libraries = [one for one in found if not isinstance(one, Part)]
        super().finalize()


_signatures: dict[Any, Any] = {}


@contextmanager
def _known_operators() -> Iterator[None]:
    """Let Numba look up once, not at every place, what an operator makes of its arguments."""
    context = cpu_target.typing_context
    if "resolve_function_type" in vars(context):
        yield
        return
    find = context.resolve_function_type

    def find_once(function: Any, arguments: Any, keywords: Any) -> Any:
        if keywords or getattr(function, "typing_key", function) not in _OPERATORS:
            return find(function, arguments, keywords)
        key = function, arguments
        if key not in _signatures:
            found = find(*key, keywords)
            if found is None:
                return None
            _signatures[key] = found
        return _signatures[key]

    context.resolve_function_type = find_once
    try:
        yield
    finally:
        del context.resolve_function_type


@contextmanager
def _no_collection() -> Iterator[None]:
    """Leave Python's garbage where it is; to look for it takes a good part of a first run.

    What has been made meanwhile goes to the oldest objects, which are looked through last.
    """
    enabled = gc.isenabled()
    try:
        gc.disable()
        yield
    finally:
        if enabled:
            # Only if nobody else keeps objects from being looked through.
            if gc.get_freeze_count() == 0:
                gc.freeze()
                gc.unfreeze()
            gc.enable()


def compile_as(kind: type[JITCodeLibrary], function: F) -> F:
    """Let a compiled function be a part of those that call it, or the whole.

    It is compiled once for all values of an argument, also where a call gives a constant.
    """
    compiled: Any = function
    compile_it, find_template = compiled.compile, compiled.get_call_template
    codegen = cpu_target.target_context.codegen()

    def compile_kind(signature: Any) -> Any:
        # Other threads that compile must not see the change.
        with global_compiler_lock:
            before = codegen._library_class
            codegen._library_class = kind
            try:
                with _known_operators(), _no_collection():
                    return compile_it(signature)
            finally:
                codegen._library_class = before

    def find_plain(arguments: Any, keywords: Any) -> Any:
        plain = {name: types.unliteral(kind) for name, kind in keywords.items()}
        return find_template([types.unliteral(kind) for kind in arguments], plain)

    compiled.compile, compiled.get_call_template = compile_kind, find_plain
    return function
