"""Shared by the scripts that write pages of figures: the revision on the page, and rows that are measured again.

A page goes stale when the program changes. Each script repeats one row of its page with --repeat: it measures the row again,
prints it beside the page's, and exits with 1 if a figure differs by more than the page's tolerance. scripts/acceptance.py runs
all of them.
"""
import os
import re
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def revision():
    """The program's revision, for a page's head: "revision d63b44f", with "and changes" if the tree differs from it."""
    done = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--exclude", "*", "--dirty= and changes"],
                          capture_output=True,
                          text=True)
    return "revision " + done.stdout.strip() if done.returncode == 0 else "an unknown revision"


def cells(row):
    return [cell.strip() for cell in row.strip().strip("|").split("|")]


def page_row(page, heading, label):
    """The page's row that starts with these cells, below a heading (empty: anywhere); none: there is no such row."""
    with open(page) as file:
        text = file.read()
    start = text.find(heading)
    for line in text[start:].splitlines() if start >= 0 else []:
        if line.startswith("|") and cells(line)[:len(label)] == label:
            return line
    return None


def numbers(cell):
    return [float(number) for number in re.findall(r"[-+]?\d+(?:\.\d+)?", cell)]


def same_cell(ours, theirs, relative, least):
    """True if both have the same words, and numbers that differ by at most this share, or by `least`."""
    pairs = list(zip(numbers(ours), numbers(theirs)))
    words = [re.sub(r"[-+]?\d+(?:\.\d+)?", "#", cell) for cell in (ours, theirs)]
    return words[0] == words[1] and all(abs(a - b) <= max(least, relative * abs(b)) + 1e-9 for a, b in pairs)


def repeated(page, heading, row, relative, least, label=1):
    """Compares a row that was measured again with the page's and prints both. True if they agree.

    label: how many cells name the row; relative [-], least [in the figures' units]: the tolerance.
    """
    path = os.path.join(ROOT, "docs", "science", page)
    old = page_row(path, heading, cells(row)[:label])
    agree = old is not None and len(cells(old)) == len(cells(row)) and all(
        same_cell(a, b, relative, least) for a, b in zip(cells(row), cells(old)))
    print(f"docs/science/{page}, tolerance {100 * relative:g} % or {least:g}: {'repeated' if agree else 'DIFFERS'}\n"
          f"  page: {old if old is not None else 'no such row'}\n  now:  {row}", flush=True)
    return agree
