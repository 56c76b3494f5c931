"""JSON documents to frozen dataclasses.

A field has the name of its JSON key, and its type says what is allowed there. Keys without a field are left to `document`,
so that newer programs can be read; a key that is missing is an error unless its field has a default.
"""
from __future__ import annotations

import dataclasses
import typing
from collections.abc import Mapping
from pathlib import Path
from types import UnionType
from typing import Any, TypeVar

from .errors import UnexpectedAnswer


@dataclasses.dataclass(frozen=True)
class Result:
    """What all results have."""

    #: the JSON object itself, with fields that this package does not name
    document: Mapping[str, Any] = dataclasses.field(default_factory=dict, kw_only=True, repr=False, compare=False)


R = TypeVar("R", bound=Result)

_ADVICE = "the program and this package are of versions that do not fit, or it is another program"


def _fields(kind: Any) -> tuple[tuple[str, Any, bool], ...]:
    """Of a result's class: name, type, and whether it has to be there."""
    hints = typing.get_type_hints(kind)
    missing = dataclasses.MISSING
    return tuple((field.name, hints[field.name], field.default is missing and field.default_factory is missing)
                 for field in dataclasses.fields(kind) if field.name != "document")


def read(kind: type[R], document: Any, place: str) -> R:
    """A result from a JSON object; `place` says where in the program's answer it is. UnexpectedAnswer if it does not fit."""
    if not isinstance(document, Mapping):
        raise UnexpectedAnswer(f"{place} should be an object, not {document!r:.80}; {_ADVICE}")
    values: dict[str, Any] = {"document": document}
    for name, hint, required in _fields(kind):
        if name in document:
            values[name] = _value(hint, document[name], f"{place}.{name}")
        elif required:
            raise UnexpectedAnswer(f"{place} has no '{name}'; {_ADVICE}")
    return kind(**values)


def read_all(kind: type[R], documents: Any, place: str) -> tuple[R, ...]:
    """Results from a JSON list."""
    return typing.cast("tuple[R, ...]", _value(tuple[kind, ...], documents, place))  # type: ignore[valid-type]


def _value(hint: Any, value: Any, place: str) -> Any:
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if hint is Any:
        return value
    if origin is UnionType:  # X | None
        return None if value is None else _value(parts[0], value, place)
    if origin is tuple and isinstance(value, list):
        return _tuple(parts, value, place)
    if origin is Mapping and isinstance(value, dict):
        return {key: _value(parts[1], one, f"{place}.{key}") for key, one in value.items()}
    if hint in _PLAIN:
        if value.__class__ in _PLAIN[hint]:
            return hint(value)
    elif isinstance(hint, type) and issubclass(hint, Result):
        return read(hint, value, place)
    raise UnexpectedAnswer(f"{place} is {value!r:.80}, not {getattr(hint, '__name__', hint)}; {_ADVICE}")


#: Types of fields, and those of JSON that are read into them: exactly, as Python's True is an int.
_PLAIN: dict[Any, tuple[type, ...]] = {str: (str,), Path: (str,), bool: (bool,), int: (int,), float: (float, int)}


def _tuple(parts: tuple[Any, ...], values: list[Any], place: str) -> tuple[Any, ...]:
    if len(parts) == 2 and parts[1] is Ellipsis:
        parts = (parts[0],) * len(values)
    if len(parts) != len(values):
        raise UnexpectedAnswer(f"{place} has {len(values)} values, not {len(parts)}; {_ADVICE}")
    return tuple(_value(part, value, f"{place}[{index}]") for index, (part, value) in enumerate(zip(parts, values)))
