#!/usr/bin/env python3
"""Holds the shared library to what is promised of it.

usage: check_shared.py LIBRARY SOURCE VERSION    exit status 1 and one line per offence

Visible are the names that headers of SOURCE declare with WEND_API, all of them, and no other name of Wend. The library
is loaded by ctypes, and a field is made, asked too early, saved and loaded again. VERSION is what it must say it is.
"""

import ctypes
import re
import subprocess
import sys
from pathlib import Path



def promised(source):
    names = set()
    for header in (source / "src" / "wend").rglob("*.h"):
        if header.parent.name == "library":
            continue  # of the renderer, which is a library of its own
        text = header.read_text()
        names.update(re.findall(r"(?:class|struct) WEND_API (\w+)", text))
        names.update(re.findall(r"WEND_API (?!const\s)[\w:<>,&*\s]*?[\s&*](\w+)\(", text))
        names.update(re.findall(r"WEND_API const char\* (\w+)\(", text))
    return names


def exported(library):
    listed = subprocess.run(["nm", "-D", "-C", "--defined-only", library], check=True, stdout=subprocess.PIPE, text=True)
    for line in listed.stdout.splitlines():
        symbol = line.split(" ", 2)[2]
        # Names of the standard library and of others may be instantiated for ours.
        yield re.sub(r"^(?:typeinfo(?: name)? for|vtable for|guard variable for) ", "", symbol)


def offences(library, source):
    names = promised(source)
    seen = set()
    for symbol in exported(library):
        # What stands before the arguments: wend::guide::Field::find.
        qualified = re.sub(r"\[abi:\w+\]", "", symbol.split("(")[0])
        if not re.match(r"(?:[\w:<>]+ )?(?:wend::|wend_)", qualified):
            continue
        parts = set(re.findall(r"\w+", qualified))
        seen |= parts & names
        if not parts & names:
            yield f"visible, and not promised: {symbol}"
    yield from (f"promised, and not visible: {name}" for name in sorted(names - seen))


class Vec3(ctypes.Structure):
    _fields_ = [(axis, ctypes.c_float) for axis in "xyz"]


class Bounds(ctypes.Structure):
    _fields_ = [("min", Vec3), ("max", Vec3)]


class Error(ctypes.Structure):
    _fields_ = [("message", ctypes.c_char * 256)]


def try_by_ctypes(library, version):
    wend = ctypes.CDLL(library)
    wend.wend_version.restype = ctypes.c_char_p
    if wend.wend_version().decode() != version:
        yield f"says it is {wend.wend_version().decode()}, not {version}"
    field, again, error, size = ctypes.c_void_p(), ctypes.c_void_p(), Error(), ctypes.c_size_t()
    bounds = Bounds(Vec3(0, 0, 0), Vec3(1, 1, 1))
    wend.wend_field_create.argtypes = [Bounds, ctypes.c_void_p, ctypes.c_void_p]
    if wend.wend_field_create(bounds, ctypes.byref(field), ctypes.byref(error)) != 0:
        yield f"no field: {error.message.decode()}"
    fluence = ctypes.c_float()
    wend.wend_field_fluence.argtypes = [ctypes.c_void_p, Vec3, ctypes.c_void_p, ctypes.c_void_p]
    if wend.wend_field_fluence(field, Vec3(0, 0, 0), ctypes.byref(fluence), ctypes.byref(error)) != 1:
        yield "a field that learned nothing was asked, and did not say so"
    wend.wend_field_save(field, None, ctypes.c_size_t(0), ctypes.byref(size), ctypes.byref(error))
    data = ctypes.create_string_buffer(size.value)
    wend.wend_field_save(field, data, size, ctypes.byref(size), ctypes.byref(error))
    if wend.wend_field_load(data, size, ctypes.byref(again), ctypes.byref(error)) != 0:
        yield f"a saved field is not loaded: {error.message.decode()}"
    bad = wend.wend_field_load(data, ctypes.c_size_t(size.value - 1), ctypes.byref(ctypes.c_void_p()), ctypes.byref(error))
    if bad != 3 or not error.message:
        yield "a cut field was loaded"
    for one in (field, again):
        wend.wend_field_destroy(one)


def main(arguments):
    if len(arguments) != 4:
        print(__doc__, file=sys.stderr)
        return 2
    library, source, version = arguments[1], Path(arguments[2]), arguments[3]
    found = [*offences(library, source), *try_by_ctypes(library, version)]
    for offence in found:
        print(offence)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
