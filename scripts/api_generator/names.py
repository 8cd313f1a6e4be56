# SPDX-License-Identifier: MIT
"""Converts names between the styles of languages."""
import re


def snake(name):
    """Converts CounterClockwise to counter_clockwise."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def pascal(name):
    """Converts counter_clockwise to CounterClockwise."""
    return "".join(part[:1].upper() + part[1:].lower() for part in name.split("_"))


def camel(name):
    made = pascal(name)
    return made[:1].lower() + made[1:]


def plural(name):
    return re.sub("iss$", "es", name + "s") if not name.endswith(("ness", "gons")) else name + "es" * name.endswith("ness")
