# SPDX-License-Identifier: MIT
"""Base of all file reports: JSON objects of the tool, with their members as attributes."""

import keyword
import re
from dataclasses import is_dataclass
from functools import lru_cache
from typing import Any, Dict, List, Type, get_args, get_type_hints


class Report:
    """JSON object of the tool (see docs/reference/json.md); its members are attributes, in snake_case.

    json: the object as a dict, with the original member names
    """

    def __init__(self, data: Dict[str, Any]):
        self.json = data

    def __getattr__(self, name: str) -> Any:
        first, *rest = name.split("_")
        member = first + "".join(word.capitalize() for word in rest)
        if name.startswith("_") or member not in self.json:
            raise AttributeError(f"the report has no member {name!r}; its members are {', '.join(dir(self))}")
        own_class: Any = type(self)
        return _wrapped(self.json[member], _kinds(own_class).get(name, Report))

    def __dir__(self) -> List[str]:
        return ["json"] + [_snake_case(member) for member in self.json]

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Report) and self.json == other.json

    def __repr__(self) -> str:
        """Returns one line; long values, lists and objects are replaced by their size."""
        shown = ", ".join(f"{_snake_case(name)}={_brief(value)}" for name, value in self.json.items())
        return f"{type(self).__name__}({shown})"


def _brief(value: Any) -> str:
    if isinstance(value, list) and value:
        return f"[{len(value)} entries]"
    if isinstance(value, dict) and value:
        return f"{{{len(value)} members}}"
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _snake_case(member: str) -> str:
    """Converts a JSON member to snake_case; appends an underscore to Python keywords (from_)."""
    name = re.sub("([A-Z])", lambda match: "_" + match[1].lower(), member)
    return name + "_" if keyword.iskeyword(name) else name


@lru_cache(maxsize=None)
def _kinds(report: Type[Any]) -> Dict[str, Type[Any]]:
    """Returns the class of each attribute that holds objects: one object, an optional one, or a list."""
    kinds = {}
    for name, hint in get_type_hints(report).items():
        while get_args(hint):
            hint = get_args(hint)[0]
        if is_dataclass(hint) or (isinstance(hint, type) and issubclass(hint, Report)):
            kinds[name] = hint
    return kinds


def _wrapped(value: Any, kind: Type[Any]) -> Any:
    if isinstance(value, list):
        return [_wrapped(entry, kind) for entry in value]
    if not isinstance(value, dict):
        return value
    if not is_dataclass(kind):
        return kind(value)
    # A newer library may have additional members.
    members = {_snake_case(name): entry for name, entry in value.items()}
    return kind(**{name: _frozen(entry, kind, name) for name, entry in members.items() if name in kind.__dataclass_fields__})


def _frozen(value: Any, kind: Type[Any], name: str) -> Any:
    """Returns the value of a member of a frozen dataclass; lists are converted to tuples."""
    if not isinstance(value, list):
        return value
    owner: Any = kind
    return tuple(_wrapped(value, _kinds(owner).get(name, Report)))
