"""Compiling what Python calls, and optimising it once.

numba makes an optimised module, machine code and two wrappers of every function, inner ones too, and optimises a callee once more in each
of its callers.  Here a kernel that kernels call is kept as it was lowered (`Lowered`).  One that Python calls is linked with everything
below it, optimised as a whole, and it alone gets machine code and a wrapper (`Linked`).
"""

import gc
import importlib
import re
import sys
from collections.abc import Callable
from typing import Any

from llvmlite import binding as llvm
from numba.core import cgutils, codegen, compiler, funcdesc, lowering, types
from numba.core.compiler_lock import global_compiler_lock
from numba.core.compiler_machinery import LoweringPass, register_pass
from numba.core.registry import CPUDispatcher
from numba.core.typing.templates import AbstractTemplate, infer_global

LANES = "drivewright._jit.lanes"  # imported by those alone that have lanes
ENVIRONMENT = "_ZN08NumbaEnv"  # how the names of places for objects begin
OPTIONS = {"nopython": True, "nogil": True, "error_model": "numpy", "boundscheck": None}


class Lowered(codegen.JITCodeLibrary):
    """The code of one function as it was lowered."""

    environment = ""  # name of the place for the objects that it may use: what numba calls its environment
    elementwise = False  # whether the turns of its loops are independent of each other

    def add_ir_module(self, ir_module: Any) -> None:
        """Take a module in from numba's lowering."""
        if not self.elementwise:
            super().add_ir_module(ir_module)
            return
        module = llvm.parse_assembly(with_independent_turns(cgutils.normalize_ir_text(str(ir_module))))
        module.name = ir_module.name
        module.verify()
        self.add_llvm_module(module)

    def add_llvm_module(self, ll_module: Any) -> None:
        """Take a module in as it is: it is optimised where it is linked."""
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Nothing more comes in."""
        self._raise_if_finalized()
        self._finalized = True


class Linked(Lowered):
    """The code of a function that Python calls, with everything that it calls."""

    def finalize(self) -> None:
        """Link, optimise and make machine code."""
        self._raise_if_finalized()
        for library in _needed(self):
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == llvm.Linkage.linkonce_odr:
                function.linkage = "internal"  # no other module calls it: inlined if called once, removed if never
        self._final_module.data_layout = self._codegen._data_layout
        passes, builder = self._codegen._module_pass_manager()  # numba's first round is for counts of references, which are few here
        passes.run(self._final_module, builder)
        self._drop_environments(builder)
        self._final_module.verify()
        self._finalize_final_module()

    def _drop_environments(self, builder):
        """Take out the places for objects of numba's own functions where no code is left that reads them: loading the kernel again would
        import the modules of those functions."""
        text = str(self._final_module)
        for variable in self._final_module.global_variables:
            if variable.name.startswith(ENVIRONMENT) and variable.name != self.environment and text.count(variable.name) == 1:
                variable.linkage = "internal"
        passes = llvm.create_new_module_pass_manager()
        passes.add_global_dead_code_eliminate_pass()
        passes.run(self._final_module, builder)

    def serialize_using_object_code(self) -> Any:
        """For the disk: the machine code and, instead of the module, the names in it."""
        self._ensure_finalized()
        names = "".join(f'define void @"{name}"() {{ ret void }}\n' for name in sorted(self._names()))
        return self.name, "object", (self._get_compiled_object(), llvm.parse_assembly(names).as_bitcode())

    def _names(self):
        """Of the functions that can be called from outside."""
        functions = self._final_module.functions
        return {each.name for each in functions if not each.is_declaration and each.linkage == llvm.Linkage.external}


def _needed(library):
    """All libraries below one, each once; numba's own have theirs in them."""
    found, waiting = {}, list(library._linking_libraries)
    while waiting:
        each = waiting.pop(0)
        if id(each) not in found:
            found[id(each)] = each
            if isinstance(each, Lowered):
                waiting += each._linking_libraries
    return found.values()


def with_independent_turns(code: str) -> str:
    """LLVM's code with a word to it: in the loops of these functions no turn touches in memory what another one writes.

    As LLVM wants it: all reads, writes and calls belong to one access group, and each branch back to the head of a loop names that group.
    """
    free = 1 + max((int(number) for number in re.findall(r"^!(\d+) = ", code, re.MULTILINE)), default=-1)
    group, words, loops, seen, lines = f"!{free}", f"!{free + 1}", free + 2, set(), []
    for line in code.splitlines():
        if label := re.match(r'"?([\w.$-]+)"?:', line):
            seen.add(label[1])
        elif line.startswith("define "):
            seen.clear()
        elif re.match(r"\s+(store |\S+ = load |(\S+ = )?call )", line):
            line += f", !llvm.access.group {group}"
        elif line.lstrip().startswith("br ") and any(target in seen for target in re.findall(r'label %"?([\w.$-]+)', line)):
            line += f", !llvm.loop !{loops}"
            loops += 1
        lines.append(line)
    lines += [f"{group} = distinct !{{}}", f'{words} = !{{!"llvm.loop.parallel_accesses", {group}}}']
    lines += [f"!{each} = distinct !{{!{each}, {words}}}" for each in range(free + 2, loops)]
    return "\n".join(lines)


class _Inside:
    """Stands for the machine code of a function that only kernels call."""


class _Lower(LoweringPass):
    """The typed function into a library of its own, as numba's pass of this name does."""

    library: type[Lowered] = Lowered

    def __init__(self) -> None:  # abstract above
        LoweringPass.__init__(self)

    def run_pass(self, state: Any) -> Any:
        """Lower, and make executable what Python calls."""
        context, flags, for_python = state.targetctx, state.flags, self.library is Linked
        state.library = library = self.library(context.codegen(), state.func_id.func_qualname)
        library.enable_object_caching()
        library.elementwise = getattr(state.func_id.func, "elementwise", False)
        function = funcdesc.PythonFunctionDescriptor.from_specialized_function(
            state.func_ir,
            state.typemap,
            state.return_type,
            state.calltypes,
            mangler=context.mangler,
            inline=flags.forceinline,
            noalias=flags.noalias,
            abi_tags=[flags.get_mangle_string()],
        )
        library.environment = context.get_env_name(function)
        with context.push_code_library(library):
            lower = lowering.Lower(context, library, function, state.func_ir, metadata=state.metadata)
            lower.lower()
            if for_python:
                lower.create_cpython_wrapper(flags.release_gil)
        entry = context.get_executable(library, function, lower.env) if for_python else _Inside()
        context.insert_user_function(entry, function, [library])
        state["cr"] = compiler._LowerResult(function, lower.call_helper, cfunc=entry, env=lower.env)
        return True


@register_pass(mutates_CFG=True, analysis_only=False)
class _LowerOnly(_Lower):
    _name = "drivewright_lowering"


@register_pass(mutates_CFG=True, analysis_only=False)
class _LowerAndLink(_Lower):
    _name = "drivewright_linking"
    library = Linked


class _ForKernels(compiler.CompilerBase):
    """numba's compiler with another lowering."""

    lower: type[_Lower] = _LowerOnly

    def define_pipelines(self) -> list[Any]:
        """numba's passes but for the lowering."""
        passes = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.passes = [(self.lower, words) if each.__name__ == "NativeLowering" else (each, words) for each, words in passes.passes]
        passes._finalized = False
        passes.finalize()
        return [passes]


class _ForPython(_ForKernels):
    lower = _LowerAndLink


class _Callee(CPUDispatcher):
    """A kernel as kernels call it."""

    def __init__(self, py_func: Callable[..., Any], targetoptions: dict[str, Any]) -> None:
        super().__init__(py_func, targetoptions=targetoptions, pipeline_class=_ForKernels)

    def add_overload(self, cres: Any) -> None:
        """Known to kernels, not to Python."""
        self.overloads[tuple(cres.signature.args)] = cres


class Kernel(CPUDispatcher):
    """A kernel as Python calls it; kernels call its `callee`."""

    _cache: Any  # a `disk_cache.KernelCache`

    def __init__(self, py_func: Callable[..., Any], locals: Any = None, targetoptions: dict[str, Any] = OPTIONS) -> None:  # noqa: A002
        self.callee, self.laned = _Callee(py_func, targetoptions), {}
        super().__init__(py_func, targetoptions=targetoptions, pipeline_class=_ForPython)

    def compile(self, sig: Any) -> Any:
        """Compile it for a signature, or take it from the disk: one thread at a time."""
        with global_compiler_lock:
            collects = gc.isenabled()
            gc.disable()  # a tenth of the time went into looking through millions of objects that are all needed until the kernel is done
            try:
                return super().compile(sig)
            finally:
                self._cache.release()
                if collects:
                    gc.enable()

    def compile_for(self, *arguments: Any) -> None:
        """Compile it for the types of these arguments, without a call."""
        self.compile(tuple(self.typeof_pyval(each) for each in arguments))

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """How kernels call it."""
        return self._callee_for(args).get_call_template(args, kws)

    def get_overload(self, sig: Any) -> Any:
        """What kernels call."""
        return self._callee_for(getattr(sig, "args", sig)).get_overload(sig)

    def _callee_for(self, args):
        """The kernel itself, or what stands for it where its arguments have lanes."""
        in_lanes, lanes = getattr(self.py_func, "in_lanes", None), sys.modules.get(LANES)
        if in_lanes is None or lanes is None or not any(lanes.is_laned(each) for each in args):
            return self.callee
        if args not in self.laned:
            function = lanes.lane_by_lane(self.callee, self.py_func.__name__, args) if in_lanes is True else getattr(lanes, in_lanes)
            self.laned[args] = _Callee(function, OPTIONS | {"_nrt": False})
        return self.laned[args]


def tell_numba_of_lanes() -> None:
    """Whoever has lanes calls it before the first kernel gets any; it takes a while.

    Never while a kernel is being compiled: what numba knows of a function by then, np.hypot, say, it would not take for the same function.
    """
    with global_compiler_lock:
        importlib.import_module(LANES)


def choose_by_type(dispatch: Callable[..., Any], formula_for: Callable[[Any], Any]) -> None:
    """Let kernels call `dispatch`: which formula that is follows from the type of the first argument, while the caller is compiled."""
    callees: dict[Any, _Callee] = {}

    class Choice(AbstractTemplate):
        """The formula of one call, as a kernel that kernels call."""

        key = dispatch

        def __init__(self, context: Any) -> None:
            super().__init__(context)
            self.chosen: dict[Any, _Callee] = {}

        def generic(self, args: Any, kws: Any) -> Any:
            """The signature of the call; numba asks for it under this name."""
            formula = formula_for(args[0])
            if formula not in callees:
                callees[formula] = getattr(formula, "callee", None) or _Callee(formula, OPTIONS)
            template, _, args, kws = callees[formula].get_call_template(args, kws)
            signature: Any = template(self.context).apply(args, kws)
            self.chosen[signature.args] = callees[formula]
            return signature

        def get_impl_key(self, sig: Any) -> Any:
            """What is called."""
            return self.chosen[sig.args].get_overload(sig.args)

    infer_global(dispatch, types.Function(Choice))
