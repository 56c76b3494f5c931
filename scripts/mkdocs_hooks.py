"""Hooks of mkdocs.yml."""
import os
import re


def on_page_markdown(markdown, **_):
    """Python-Markdown knows a block by its language alone: ```sh no-run (scripts/check_docs.py) becomes ```sh."""
    return re.sub(r"^(```\w+) .*$", r"\1", markdown, flags=re.M)


def on_post_build(config, **_):
    """The search's index as a script, too: pages from the disk can load it (docs/assets/search_from_disk.js)."""
    folder = os.path.join(config["site_dir"], "search")
    with open(os.path.join(folder, "search_index.json"), encoding="utf-8") as index:
        text = index.read()
    with open(os.path.join(folder, "search_index.js"), "w", encoding="utf-8") as script:
        script.write(f"const search_index = {text};\n")
