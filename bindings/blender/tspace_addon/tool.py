# SPDX-License-Identifier: MIT
"""Finds and runs the program tspace, and reads its reports."""

import json
import os
import shutil
import subprocess
import sys

import bpy


class Failed(Exception):
    """Error with a message for the status bar."""


def path():
    """Returns the path of the program: that of the preferences, else the one in this add-on, else the one in PATH."""
    entry = bpy.context.preferences.addons.get(__package__)
    chosen = bpy.path.abspath(entry.preferences.program) if entry and entry.preferences else ""
    name = "tspace.exe" if sys.platform == "win32" else "tspace"
    shipped = os.path.join(os.path.dirname(__file__), "bin", name)
    if chosen:
        if not os.access(chosen, os.X_OK):
            raise Failed(f"the preferences of tspace refer to {chosen}, which is not a program")
        return chosen
    if os.path.exists(shipped) and not os.access(shipped, os.X_OK):
        os.chmod(shipped, 0o755)  # Blender unpacks add-ons without it
    found = shipped if os.access(shipped, os.X_OK) else shutil.which("tspace")
    if not found:
        raise Failed("the program tspace was not found: install it, or set its path in the preferences of this add-on")
    return found


def report(command, *arguments):
    """Returns the JSON report of a command. Exit code 1 (findings) is not an error."""
    program = [path(), command, "--json", *map(str, arguments)]
    done = subprocess.run(program, capture_output=True, text=True, encoding="utf-8", check=False)
    try:
        document = json.loads(done.stdout)
    except ValueError:
        words = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        raise Failed(f"tspace {command}: {words[-1]}") from None
    for place in (document, *document.get("files", ())):
        if place.get("error") and "message" in place["error"]:
            raise Failed(f"tspace {command}: {place['error']['message']}")
    return document
