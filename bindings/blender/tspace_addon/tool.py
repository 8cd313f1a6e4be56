# SPDX-License-Identifier: MIT
"""The program tspace: where it is, and its reports."""

import json
import os
import shutil
import subprocess
import sys

import bpy


class Failed(Exception):
    """A sentence for the status bar."""


def path():
    """The program of the preferences, the one in this add-on, or the one in PATH."""
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
    """The JSON of a command. Findings (exit code 1) are no failure."""
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
