"""Hooks of mkdocs.yml."""
import re


def on_page_markdown(markdown, **_):
    """Python-Markdown knows a block by its language alone: ```sh no-run (scripts/check_docs.py) becomes ```sh."""
    return re.sub(r"^(```\w+) .*$", r"\1", markdown, flags=re.M)
