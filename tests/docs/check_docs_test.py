#!/usr/bin/env python3
"""scripts/check_docs.py finds the faults that it is there for. Usage: check_docs_test.py PROGRAM"""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import check_docs  # noqa: E402

PROGRAM = check_docs.Program(os.path.abspath(sys.argv.pop(1)))


class Pages(unittest.TestCase):
    """Each test writes a page into a repository of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(setattr, check_docs, "ROOT", check_docs.ROOT)
        self.addCleanup(check_docs.anchors.cache_clear)
        check_docs.ROOT = folder.name
        os.makedirs(os.path.join(folder.name, "docs", "user"))

    def write(self, *lines, page="docs/user/page.md"):
        with open(os.path.join(check_docs.ROOT, page), "w") as file:
            file.write("\n".join(lines) + "\n")
        return page

    def test_links_lead_to_pages_and_titles(self):
        page = self.write("# A title", "[here](#a-title) [there](other.md#how-do-i) [away](https://example.org)")
        self.write("## How do I?", page="docs/user/other.md")
        self.assertEqual(list(check_docs.link_faults(page)), [])

    def test_broken_links_are_faults(self):
        self.write("# Other", page="docs/user/other.md")
        self.write("# Outside", page="README.md")
        for target in ("none.md", "#none", "other.md#none", "../../README.md", "../picture.png"):
            with self.subTest(target):
                self.assertEqual(len(list(check_docs.link_faults(self.write(f"[x]({target})")))), 1)

    def test_words_on_pictures_are_the_windows(self):
        for folder in ("docs/pictures", "workbench"):
            os.makedirs(os.path.join(check_docs.ROOT, folder))
        self.write('button("Apply and run"); row("clip-opening"); counted(n, "warning");', page="workbench/panel.cpp")
        self.write("", page="docs/pictures/form.png")
        for words, faults in ((["Apply and run", "Clip opening", "Read 3 warnings", "tube.vbench"], 1),
                              (["Apply", "3 warning"], 0), (["Apply now"], 1)):
            with self.subTest(words):
                self.write(check_docs.json.dumps({"form": words}), page="docs/pictures/labels.json")
                self.assertEqual(len(list(check_docs.picture_faults())), faults)
        self.write('{"none": []}', page="docs/pictures/labels.json")
        self.assertEqual(len(list(check_docs.picture_faults())), 1)

    def test_links_in_blocks_and_code_are_none(self):
        self.assertEqual(list(check_docs.link_faults(self.write("`[x](none.md)`", "```text", "[x](none.md)", "```"))), [])

    def test_what_the_site_shows_otherwise_is_a_fault(self):
        for lines in (["text", "- item"], ["- item", "", "  ```sh", "  ```"], ["```ruby", "```"], ["## [x](page.md)"]):
            with self.subTest(lines):
                self.assertEqual(len(list(check_docs.site_faults(self.write(*lines)))), 1)

    def test_commands_that_exist_have_no_faults(self):
        page = self.write("`vesselbench log P`, `vesselbench COMMAND --help`", "", "```sh no-run",
                          "vesselbench prepare a.stl --for cfd --set remesh.edge=0.2 --set openfoam.flow=2 --out a  # --none",
                          "mkdir a && vesselbench apply P smooth staircase=true --note 'why -- not'", "```")
        self.assertEqual([*check_docs.block_faults(page, PROGRAM), *check_docs.code_faults(page, PROGRAM)], [])

    def test_commands_that_do_not_exist_are_faults(self):
        for command in ("vesselbench none", "vesselbench log P --none", "vesselbench --none", "cd a && vesselbench none",
                        "vesselbench apply P none", "vesselbench apply P smooth none=1",
                        "vesselbench prepare a --set remesh.none=1", "vesselbench prepare a --set openfoam.none=1",
                        "scripts/none", "scripts/check --none"):
            with self.subTest(command):
                page = self.write("```sh", command, "```")
                self.assertEqual(len(list(check_docs.block_faults(page, PROGRAM))), 1)
        self.assertEqual(len(list(check_docs.code_faults(self.write("see `vesselbench none`"), PROGRAM))), 1)
        self.assertEqual(len(list(check_docs.block_faults(self.write("    vesselbench log P"), PROGRAM))), 1)

    def test_a_block_that_fails_is_a_fault(self):
        page = self.write("```sh", "vesselbench operations smooth > out", "test -s out", "```", "```sh no-run", "false", "```",
                          "```sh", "vesselbench log none.vbench", "true", "```")
        with tempfile.TemporaryDirectory() as prepared:
            faults = check_docs.run_faults(page, PROGRAM, prepared)
        self.assertEqual(len(faults), 1)
        self.assertIn("exit code 3", faults[0])

    def test_python_blocks_are_one_script(self):
        page = self.write("```python", "import vesselbench", "version = vesselbench.version()", "```", "text",
                          "```python", "assert version", "```", "", "```python", "", "assert not version", "```")
        with tempfile.TemporaryDirectory() as prepared:
            faults = check_docs.run_faults(page, PROGRAM, prepared)
        self.assertEqual(len(faults), 1)
        self.assertIn('page.md", line 12', faults[0])
        self.assertTrue(faults[0].endswith("AssertionError"))

    def test_sources_in_a_network_are_faults(self):
        self.write('<a href="https://example.org">', '<script src="js/a.js">', '<link href="https://example.org/a.css" rel="x">',
                   "<img src=//example.org/a.png>", page="docs/user/page.html")
        self.assertEqual(len(list(check_docs.network_faults(check_docs.ROOT))), 2)


if __name__ == "__main__":
    unittest.main()
