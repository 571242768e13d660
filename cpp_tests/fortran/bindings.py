#!/usr/bin/env python3
"""Holds planish.f90 against planish.h.

    bindings.py HEADER MODULE                      fails unless both have the same functions with the same arguments,
                                                   the same records with the same fields, the same enumerators
    bindings.py HEADER MODULE --write LAYOUT_C LAYOUT_F90
                                                   writes a program that compares sizes, offsets, values and defaults
"""
import re
import sys

KINDS = {
    "double": "real(c_double)", "char": "character(kind=c_char)", "size_t": "integer(c_size_t)",
    "int32_t": "integer(c_int32_t)", "uint32_t": "integer(c_int32_t)", "uint8_t": "integer(c_int8_t)",
    "int64_t": "integer(c_int64_t)", "uint64_t": "integer(c_int64_t)", "planish_status": "integer(c_int)",
    "const char *": "type(c_ptr)", "planish_progress": "type(c_funptr)", "void": None,
}


class Header:
    """What planish.h declares."""

    FUNCTION = r"PLANISH_API\s+(?:PLANISH_NODISCARD\s+)?([\w\s]+?[\s*]+)(planish_\w+)\(([^;]*)\);"

    def __init__(self, text):
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
        text = re.sub(r"\b(struct|enum) (planish_\w+)", r"\2", text)
        self.enumerators = re.findall(r"^\s+(PLANISH_\w+) = -?\d+,", text, re.M)
        self.records = {}
        for body, name in re.findall(r"typedef planish_\w+ \{([^{}]*;)\s*\} (planish_\w+);", text):
            self.records[name] = [self.field(line) for line in body.split(";") if line.strip()]
        self.functions = {}
        for result, name, arguments in re.findall(self.FUNCTION, text):
            arguments = [] if arguments == "void" else [self.argument(part) for part in arguments.split(",")]
            self.functions[name] = (KINDS[" ".join(result.split())], arguments)

    @staticmethod
    def field(line):
        base, stars, name, count = re.fullmatch(r"\s*(?:const )?(\w+) (\**)(\w+)(\[\d+\])?\s*", line).groups()
        return name, "type(c_ptr)" if stars else KINDS[base], (count or "").replace("[", "(").replace("]", ")")

    def argument(self, text):
        """Name and declaration; `optional` may come to it where C allows NULL."""
        const, base, handles, stars, name = re.fullmatch(r"\s*(const )?(\w+) (\*const )?(\**)(\w+)\s*", text).groups()
        intent = "intent(in)" if const else "intent(inout)"
        if handles:
            return name, ("type(c_ptr)", "intent(in)")  # an array of them
        if stars == "":
            return name, (KINDS[base], "value")
        if stars == "**":
            return name, ("type(c_ptr)", "intent(inout)")
        if base == "void":
            return name, (KINDS["uint8_t"], intent)  # bytes
        if base in KINDS:
            return name, (KINDS[base], intent)
        if base in self.records:
            return name, (f"type({base})", intent)
        return name, ("type(c_ptr)", "value")  # a handle


class Module:
    """What planish.f90 declares."""

    INTERFACE = (r"^ +(?:pure )?(?:(\S+) function|subroutine) c_(\w+)\(([^\n]*?)\) ?bind\(c, name=\"(\w+)\"\)\n"
                 r"(.*?)\n +end (?:function|subroutine)")

    def __init__(self, text):
        text = re.sub(r"&\n\s*", "", text)
        lines = [re.sub(r"\s*!.*", "", line) for line in text.splitlines()]
        text = "\n".join(lines)
        self.enumerators = re.findall(r"parameter, public :: (PLANISH_\w+) =", text)
        self.records = {}
        for name, body in re.findall(r"type, bind\(c\), public :: (\w+)\n(.*?)\n\s*end type", text, re.S):
            self.records[name] = re.findall(r"^ +(\S+) :: (\w+)(\(\d+\))? = ", body, re.M)
            self.records[name] = [(field, kind, count) for kind, field, count in self.records[name]]
        self.functions = {}
        for result, local, names, bound, body in re.findall(self.INTERFACE, text, re.S | re.M):
            if bound != "planish_" + local:
                problem(f"c_{local} is bound to {bound}")
            declared = {}
            for attributes, variables in re.findall(r"^ +(.*?) :: (.*)$", body, re.M):
                attributes = tuple(part for part in attributes.split(", ") if part != "optional")
                for variable in variables.split(", "):
                    declared[variable.removesuffix("(*)")] = attributes
            if "implicit none" not in body:
                problem(f"{bound} lacks implicit none")
            names = [name.strip() for name in names.split(",") if name.strip()]
            self.functions[bound] = (result or None, [(name, declared.get(name)) for name in names])


problems = []


def problem(text):
    problems.append(text)


def compare(header, module):
    for what in ("functions", "records"):
        ours, theirs = getattr(module, what), getattr(header, what)
        for name in sorted(set(ours) | set(theirs)):
            if name not in ours:
                problem(f"{name} is missing in the module")
            elif name not in theirs:
                problem(f"{name} is not in the header")
            elif ours[name] != theirs[name]:
                problem(f"{name} is {ours[name]},\n    in the header {theirs[name]}")
    for name in sorted(set(module.enumerators) ^ set(header.enumerators)):
        if name != "PLANISH_UNLIMITED":  # a macro of the header
            problem(f"{name} is only in the {'module' if name in module.enumerators else 'header'}")


def write_layout(header, path_c, path_f90):
    records = list(header.records)
    offsets = [f"offsetof({record}, {field})" for record in records for field, _, _ in header.records[record]]
    inits = "\n".join(f"    case {i}: return {record}_init(&expected.r{i}, sizeof expected.r{i}) == PLANISH_STATUS_OK;"
                      for i, record in enumerate(records) if record + "_init" in header.functions)
    with open(path_c, "w", encoding="ascii") as file:
        file.write(f"""/* Written by bindings.py: what C says of the records and enumerators of planish.h. */
#include <planish.h>

#include <stddef.h>
#include <string.h>

static const size_t sizes[] = {{{", ".join(f"sizeof({record})" for record in records)}}};
static const size_t offsets[] = {{{", ".join(offsets)}}};
static const int64_t values[] = {{{", ".join(header.enumerators)}, PLANISH_UNLIMITED}};
static union {{
  size_t struct_size;
  {" ".join(f"{record} r{i};" for i, record in enumerate(records))}
}} expected;

/* Fills `expected` with the defaults. A report's are its size and zeros. */
static int init(int32_t record) {{
  memset(&expected, 0, sizeof expected);
  switch (record) {{
{inits}
  }}
  expected.struct_size = sizes[record];
  return 1;
}}

size_t size_in_c(int32_t record);
size_t offset_in_c(int32_t field);
int64_t value_in_c(int32_t enumerator);
int32_t is_default_in_c(int32_t record, const void *bytes);
size_t size_in_c(int32_t record) {{ return sizes[record]; }}
size_t offset_in_c(int32_t field) {{ return offsets[field]; }}
int64_t value_in_c(int32_t enumerator) {{ return values[enumerator]; }}
int32_t is_default_in_c(int32_t record, const void *bytes) {{
  return init(record) && memcmp(&expected, bytes, sizes[record]) == 0;
}}
""")
    declarations, checks, field_number = [], [], 0
    for i, record in enumerate(records):
        declarations.append(f"  type({record}), target :: r{i}")
        checks.append(f'  call check(c_sizeof(r{i}) == size_in_c({i}), "size of {record}")')
        checks.append(f'  call check(is_default_in_c({i}, c_loc(r{i})) == 1, "defaults of {record}")')
        for field, _, _ in header.records[record]:
            checks.append(f"  call check(distance(c_loc(r{i}), c_loc(r{i}%{field})) == offset_in_c({field_number}), &")
            checks.append(f'      "offset of {record}%{field}")')
            field_number += 1
    for i, name in enumerate(header.enumerators):
        checks.append(f'  call check(value_in_c({i}) == {name}, "{name}")')
    unlimited = len(header.enumerators)
    checks.append(f'  call check(int(value_in_c({unlimited}), c_int32_t) == PLANISH_UNLIMITED, "PLANISH_UNLIMITED")')
    newline = "\n"
    with open(path_f90, "w", encoding="ascii") as file:
        file.write(f"""! Written by bindings.py: what Fortran says of the same.
program test_layout
  use, intrinsic :: iso_c_binding
  use planish
  use checks
  implicit none
  interface
    integer(c_size_t) function size_in_c(record) bind(c)
      import
      integer(c_int32_t), value :: record
    end function
    integer(c_size_t) function offset_in_c(field) bind(c)
      import
      integer(c_int32_t), value :: field
    end function
    integer(c_int64_t) function value_in_c(enumerator) bind(c)
      import
      integer(c_int32_t), value :: enumerator
    end function
    integer(c_int32_t) function is_default_in_c(record, bytes) bind(c)
      import
      integer(c_int32_t), value :: record
      type(c_ptr), value :: bytes
    end function
  end interface
{newline.join(declarations)}
{newline.join(checks)}
  call finish()
contains
  !> Bytes from one address to another.
  integer(c_size_t) function distance(from, to)
    type(c_ptr), intent(in) :: from, to
    distance = transfer(to, 0_c_intptr_t) - transfer(from, 0_c_intptr_t)
  end function
end program
""")


with open(sys.argv[1], encoding="utf-8") as file:
    header = Header(file.read())
if sys.argv[3:4] == ["--write"]:
    write_layout(header, *sys.argv[4:])
else:
    with open(sys.argv[2], encoding="utf-8") as file:
        module = Module(file.read())
    compare(header, module)
    print("\n".join(problems + [
        f"{len(header.functions)} functions, {len(header.records)} records, {len(header.enumerators)} enumerators, "
        f"{len(problems)} differences"]))
    sys.exit(bool(problems) or not header.functions or not header.records)
