#!/usr/bin/env python3
"""Writes a program that compares records and names of Fortran with those of C: sizes, offsets, values and defaults.

    layout.py API_JSON LAYOUT_C LAYOUT_F90
"""
import json
import sys


def write_layout(api, path_c, path_f90):
    fields = {record["name"]: [field["name"] for field in record["fields"]] for record in api["records"]}
    records = list(fields)
    functions = {function["name"] for function in api["functions"]}
    enumerators = [each["name"] for enumeration in api["enumerations"] for each in enumeration["enumerators"]]
    offsets = [f"offsetof({record}, {field})" for record in records for field in fields[record]]
    inits = "\n".join(f"    case {i}: return {record}_init(&expected.r{i}, sizeof expected.r{i}) == PLANISH_STATUS_OK;"
                      for i, record in enumerate(records) if record + "_init" in functions)
    with open(path_c, "w", encoding="ascii") as file:
        file.write(f"""/* Written by layout.py: what C says of the records and enumerators of planish.h. */
#include <planish.h>

#include <stddef.h>
#include <string.h>

static const size_t sizes[] = {{{", ".join(f"sizeof({record})" for record in records)}}};
static const size_t offsets[] = {{{", ".join(offsets)}}};
static const int64_t values[] = {{{", ".join(enumerators)}, PLANISH_UNLIMITED}};
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
        for field in fields[record]:
            checks.append(f"  call check(distance(c_loc(r{i}), c_loc(r{i}%{field})) == offset_in_c({field_number}), &")
            checks.append(f'      "offset of {record}%{field}")')
            field_number += 1
    for i, name in enumerate(enumerators):
        checks.append(f'  call check(value_in_c({i}) == {name}, "{name}")')
    unlimited = len(enumerators)
    checks.append(f'  call check(int(value_in_c({unlimited}), c_int32_t) == PLANISH_UNLIMITED, "PLANISH_UNLIMITED")')
    newline = "\n"
    with open(path_f90, "w", encoding="ascii") as file:
        file.write(f"""! Written by layout.py: what Fortran says of the same.
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
    write_layout(json.load(file), *sys.argv[2:])
