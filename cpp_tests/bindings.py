#!/usr/bin/env python3
"""Holds what is written by hand, planish.hpp and planish.f90, against bindings/planish.api.json.

    bindings.py API_JSON PLANISH_HPP PLANISH_F90

Every function of planish.h must be called by both, or stand below with a reason.
"""
import json
import re
import sys

# What a binding leaves out on purpose: the function, and why users do not miss it.
EXCEPTIONS = {
    "planish.hpp": {},
    "planish.f90": {},
}


def called(text):
    """The functions that a source calls: whole words before a parenthesis, outside of comments."""
    return set(re.findall(r"\b(\w+)\s*\(", text))


def problems(functions, binding, names):
    excepted = EXCEPTIONS[binding]
    for function in functions:
        if function not in names and function not in excepted:
            yield f"{binding} lacks {function}()"
        if function in names and function in excepted:
            yield f"{binding} calls {function}(), which bindings.py lists as left out"
    for function in sorted(set(excepted) - set(functions)):
        yield f"bindings.py lists {function}(), which planish.h does not have"


def main(api, hpp, f90):
    with open(api, encoding="utf-8") as file:
        functions = [function["name"] for function in json.load(file)["functions"]]
    with open(hpp, encoding="utf-8") as file:
        cpp = called(re.sub(r"/\*.*?\*/|//[^\n]*", "", file.read(), flags=re.S))
    with open(f90, encoding="utf-8") as file:
        fortran = called(re.sub(r"![^\n]*", "", file.read()))
    # planish_c.f90, which is generated, has one name for all functions that fill options
    fortran |= {"c_" + function.removeprefix("planish_") for function in functions if function.endswith("_options_init")}
    fortran = {"planish_" + name.removeprefix("c_") for name in fortran if name.startswith("c_")}
    found = [*problems(functions, "planish.hpp", cpp), *problems(functions, "planish.f90", fortran)]
    print("\n".join([*found, f"{len(functions)} functions, {len(found)} differences"]))
    return bool(found) or not functions


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
