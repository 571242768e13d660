"""Writes the page of all functions, by subject, with their names in C++, Fortran and Python.

Usage: functions.py ROOT PAGE

What a function does comes from bindings/planish.api.json; its names elsewhere are read from the wrappers themselves, so
that the page cannot promise what is not there.
"""

import ast
import json
import re
import sys
from pathlib import Path

#: Sections in order: title, and the beginnings of the names that belong there. The first that fits takes a function.
SECTIONS = [
    ("Versions and errors", ("planish_version", "planish_check_version", "planish_status", "planish_error", "planish_stage")),
    ("Layouts and sphere maps", ("planish_layout", "planish_mesh_map_to_sphere", "planish_sphere")),
    ("Features", ("planish_mesh_find_features", "planish_mesh_label_parts", "planish_feature")),
    ("Meshes", ("planish_mesh", "planish_decimate", "planish_parameterize", "planish_sample_rows")),
    ("Models: solids and shells", ("planish_model", "planish_edge", "planish_face")),
    ("Tensor surfaces", ("planish_tensor",)),
    ("PHT-splines", ("planish_pht",)),
    ("T-splines", ("planish_tspline", "planish_skin")),
    ("D1RC-splines", ("planish_d1rc",)),
    ("Fields", ("planish_field", "planish_transfer", "planish_surface_field")),
    ("Curves", ("planish_curve", "planish_interpolate")),
    ("Any surface", ("planish_",)),
]


#: What users write for Python's special methods.
SPOKEN = {
    "__copy__": "copy.copy({0})",
    "__getitem__": "{0}[name]",
    "__setitem__": "{0}[name] = values",
    "__delitem__": "del {0}[name]",
}

#: Calls that no wrapper shows: records are born with their defaults, handles free themselves.
SILENT = ("_init", "_free")


def cpp_names(text):
    """C function to the C++ member that calls it: the class that is open, and the function whose body it stands in."""
    names, scope, function = {}, None, None
    for line in text.splitlines():
        if opened := re.match(r"(?:class|struct) (\w+)", line):
            scope = opened[1]
        elif line.startswith("};"):
            scope = None
        if started := re.match(r"\s{0,2}(?:template.*> )?(?:\[\[nodiscard\]\] )?(?:static |inline |explicit )*[\w:<>,&* ]*?\b(\w+)\(", line):
            if len(line) - len(line.lstrip()) <= 2 and not line.rstrip().endswith(";"):
                function = started[1]
        for name in re.findall(r"\b(planish_\w+)\(", line):
            if function and name not in names:
                names[name] = f"{scope}::{function}" if scope and scope != function else (function or scope)
    return names


def fortran_names(text):
    """C function to the procedure that calls its raw interface, as users write it."""
    bound, public = {}, {}
    type_name = None
    for line in text.splitlines():
        if opened := re.match(r"\s*type(?:, [\w()]+)*\s*::\s*(\w+)", line):
            type_name = opened[1]
        if found := re.match(r"\s*procedure(?:, \w+)?\s*::\s*(\w+)\s*=>\s*(\w+)", line):
            bound[found[2]] = f"{type_name}%{found[1]}"
        if found := re.match(r"\s*generic(?:, \w+)?\s*::\s*(\w+)\s*=>\s*([\w, ]+)", line):
            for procedure in found[2].split(","):
                public[procedure.strip()] = f"{type_name}%{found[1]}"
    generics = {procedure: public.get(name.split("%")[1], name) for procedure, name in bound.items()}
    names, inside = {}, None
    for line in text.splitlines():
        if started := re.match(r"\s*(?:\w[\w() ,]*\s)?(?:subroutine|function)\s+(\w+)\s*\(", line):
            if not line.strip().startswith("end"):
                inside = started[1]
        for name in re.findall(r"\bc_(\w+)\(", line):
            if inside:
                names.setdefault("planish_" + name, generics.get(inside, inside))
    return names


def python_names(folder):
    """C function to the public Python function or method in which its name stands."""
    names = {}
    for path in sorted(folder.glob("_*.py")):
        if path.name == "_abi.py":
            continue
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef):
                for member in node.body:
                    if isinstance(member, ast.FunctionDef):
                        is_made = member.name in ("__init__", "_own")
                        shown = node.name if is_made else f"{node.name}.{member.name}"
                        _collect(member, shown.removesuffix(".__call__"), names)
                    else:
                        _collect(member, node.name, names)
            elif isinstance(node, ast.FunctionDef):
                _collect(node, f"planish.{node.name}", names)
    return names


def _collect(node, shown, names):
    last = shown.split(".")[-1]
    if last in SPOKEN:
        shown = SPOKEN[last].format(shown.split(".")[0].lower())
    is_private = last.startswith("_") and last not in SPOKEN
    for part in ast.walk(node):
        found = None
        if isinstance(part, ast.Constant) and isinstance(part.value, str):
            found = part.value if re.fullmatch(r"planish_\w+", part.value) else None
        elif isinstance(part, ast.Attribute) and part.attr.startswith("planish_"):
            found = part.attr
        if found and not is_private:
            names.setdefault(found, shown)


def section_of(name):
    return next(title for title, beginnings in SECTIONS if name.startswith(beginnings))


def first_sentence(text):
    end = re.search(r"\.(?:\s|$)", text)
    return text[: end.start()] if end else text


def page(root):
    api = json.loads((root / "bindings/planish.api.json").read_text())
    others = (
        cpp_names((root / "include/planish.hpp").read_text()),
        fortran_names((root / "include/planish.f90").read_text()),
        python_names(root / "python/planish"),
    )
    groups = {title: [] for title, _ in SECTIONS}
    for function in api["functions"]:
        if not function["name"].endswith(SILENT):
            groups[section_of(function["name"])].append(function)
    lines = [
        "# Functions",
        "",
        f"The functions of `planish.h`, version {api['version']}. What each argument",
        "must be stands in the header. In C++ the names are in namespace `planish`, in Fortran in module `planish`; empty means that",
        "the language needs no such call. Each record has a `_init` that fills the defaults, each handle a `_free`.",
    ]
    for title, functions in groups.items():
        if not functions:
            continue
        lines += ["", f"## {title}", "", "| C | does | C++ | Fortran | Python |", "|---|---|---|---|---|"]
        for function in functions:
            name = function["name"]
            shown = [f"`{names[name]}`" if name in names else "" for names in others]
            text = first_sentence(function["text"]).replace("|", "\\|")
            lines.append(f"| `{name}` | {text} | {' | '.join(shown)} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(page(Path(sys.argv[1])))
