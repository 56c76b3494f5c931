"""Values of Python as words of a command line."""
from __future__ import annotations

import json
import numbers
import os
from collections.abc import Iterable, Mapping
from typing import Any, Union

#: What an operation's parameter takes: a number, a text, a file, True or False; a place, or several numbers, as any iterable
#: of them (numpy's arrays too); records as a list of mappings. None: not given.
Argument = Union[str, "os.PathLike[str]", bool, float, Iterable[Any], None]
#: What a command's option takes: the same; True is a switch; a list repeats the option.
Option = Argument


def name_of(keyword: str) -> str:
    """A trailing underscore is left out, so that Python's own words can be names: lambda_=0.5."""
    return keyword.removesuffix("_")


def option_words(options: Mapping[str, Option]) -> list[str]:
    """{'accept_doubts': True, 'inlet': [1, (3, 4, 5)]} is --accept-doubts --inlet=1 --inlet=3,4,5"""
    words = []
    for keyword, value in options.items():
        option = "--" + name_of(keyword).replace("_", "-")
        value = _plain(value)
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            for one in value if isinstance(value, list) else [value]:
                words.append(f"{option}={text_of(one, keyword)}")
    return words


def setting_words(settings: Mapping[str, Argument] | None) -> list[str]:
    """{'remesh.edge': 0.2} is --set=remesh.edge=0.2"""
    return [f"--set={word}" for word in parameter_words(settings or {})]


def parameter_words(parameters: Mapping[str, Argument]) -> list[str]:
    """{'lambda_': 0.5, 'at': (1, 2, 3)} is lambda=0.5 at=1,2,3"""
    return [f"{name_of(keyword)}={text_of(value, keyword)}" for keyword, value in parameters.items() if value is not None]


def text_of(value: Argument, called: str) -> str:
    """A value as the command line takes it. TypeError if there is no way to write it."""
    value = _plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, Iterable) and not isinstance(value, (Mapping, bytes)):
        several = list(value)
        if any(isinstance(one, Mapping) for one in several):
            return json.dumps(several)
        return ",".join(text_of(one, called) for one in several)
    raise TypeError(f"{called} = {value!r:.80} is no number, text, path, True or False, place or list of them")


def _plain(value: Any) -> Any:
    """numpy's scalars and arrays as Python's: an array of a place is one value, rows of places are several."""
    if not hasattr(value, "tolist"):
        return value
    value = value.tolist()
    if isinstance(value, list):
        return [tuple(row) for row in value] if value and isinstance(value[0], list) else tuple(value)
    return value
