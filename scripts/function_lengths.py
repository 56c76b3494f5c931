#!/usr/bin/env python3
"""Prints how long the functions of the product are: median, 95th percentile, maximum, the longest.

Lengths are those of clang-tidy's readability-function-size: lines from the opening to the closing
brace, of which one counts; at least 1. A lambda belongs to the function around it. Fails if a
function is longer than --limit.

    scripts/function_lengths.py [--longest 20] [--limit 60] [FOLDER...]
"""
import argparse
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["geometry", "smoothing", "gpu", "meshing", "workbench"]
SUFFIXES = {".h", ".cpp", ".inc"}

NOT_CODE = re.compile(
    r"""//[^\n]* | /\*.*?\*/ | R"(?P<mark>\w*)\(.*?\)(?P=mark)" | "(?:\\.|[^"\\\n])*"
        | (?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*' | ^[ \t]*\#(?:\\\n|[^\n])*""",
    re.VERBOSE | re.DOTALL | re.MULTILINE)
TEMPLATE = re.compile(r"^\s*template\s*<[^{};]*?>\s*(?=[A-Za-z\[])")


def blanked(text):
    """The text with everything but code as blanks, line by line as long as before."""
    return NOT_CODE.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def kind_of(head):
    """What the brace after these words opens: "scope", "function" or "other"."""
    head = re.sub(r"\b(public|private|protected)\s*:", "", head).strip()
    head = TEMPLATE.sub("", head)
    if re.match(r"(inline\s+)?namespace\b|extern\b\s*$|(class|struct|union|enum)\b", head):
        return "scope"
    before_parameters = head.split("(", 1)[0]
    if "(" not in head or re.search(r"(?<!operator)(?<![=!<>+\-*/])=(?!=)", before_parameters):
        return "other"
    in_initialisers = re.search(r"\)\s*(noexcept\s*)?:(?!:)", head)
    if in_initialisers and re.search(r"[\w>]\s*$", head):
        return "other"
    return "function"


def functions(text):
    """Yields (name, first line, number of lines) of every function."""
    code = blanked(text)
    open_braces, head, line = [], "", 1
    for letter in code:
        line += letter == "\n"
        in_function = any(kind == "function" for kind, *_ in open_braces)
        if letter == "{":
            open_braces.append(("other" if in_function else kind_of(head), head, line))
            head = ""
        elif letter == "}" and open_braces:
            kind, before, first = open_braces.pop()
            if kind == "function":
                name = re.search(r"(operator\s*[^\s(]+|[\w:~]+)\s*\(", before)
                yield (name.group(1) if name else "?"), first, max(1, line - first)
            head = before + "{}" if kind == "other" and not in_function else ""
        elif letter == ";":
            head = ""
        else:
            head += letter


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="*", default=FOLDERS)
    parser.add_argument("--longest", type=int, default=20, help="how many are listed")
    parser.add_argument("--limit", type=int, default=60, help="lines that no function may pass")
    arguments = parser.parse_args()
    found = []
    for folder in arguments.folders:
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in SUFFIXES:
                name = file.relative_to(ROOT)
                found += [(length, f"{name}:{line}", function)
                          for function, line, length in functions(file.read_text())]
    lengths = sorted(length for length, *_ in found)
    if not lengths:
        sys.exit("no functions found")
    print(f"{len(lengths)} functions: median {statistics.median(lengths):g} lines, 95th percentile "
          f"{lengths[len(lengths) * 95 // 100]}, longest {lengths[-1]}")
    for length, place, function in sorted(found, reverse=True)[:arguments.longest]:
        print(f"{length:5}  {place}  {function}")
    return 1 if lengths[-1] > arguments.limit else 0


if __name__ == "__main__":
    sys.exit(main())
