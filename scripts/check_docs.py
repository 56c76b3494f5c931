#!/usr/bin/env python3
"""Checks README.md and docs/ as a reader uses them; a ctest for each part.

  scripts/check_docs.py links                  every relative link and anchor leads somewhere, and what the site needs holds
  scripts/check_docs.py commands [--program P] every command in blocks and in `code` exists, with its options and parameters
  scripts/check_docs.py run [--program P] [PAGE]...   the blocks of README.md and docs/user run
  scripts/check_docs.py pictures               every word on a picture of the window is one that the window has
  scripts/check_docs.py site                   mkdocs makes a site without a network; its search answers what users ask

A block ```sh is run in a folder of its page, in which `vesselbench prepare aneurysm --for cfd --out case` has run; then the
page's blocks ```python, one after the other as one script. A block ```sh no-run, whose files are the reader's, is only
parsed. Exit code 1 with a line for each fault.
"""
import concurrent.futures
import functools
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import common

ROOT = common.ROOT
PREPARED = "vesselbench prepare aneurysm --for cfd --out case"
HIDDEN = {"--markdown"}  # options that the help leaves out
COMMAND = re.compile(r"(?:build/release/)?(vesselbench|scripts/[a-z_]+(?:\.py)?)(?=\s|$)")
FENCE = re.compile(r"^( *)```(.*)$")


def pages():
    """README.md, the other pages beside it, and all of docs/, relative to the repository."""
    found = [name for name in sorted(os.listdir(ROOT)) if name.endswith(".md") and name != "CHANGELOG.md"]
    for folder, _, names in sorted(os.walk(os.path.join(ROOT, "docs"))):
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in sorted(names) if name.endswith(".md")]
    return found


def lines_of(page):
    with open(os.path.join(ROOT, page)) as file:
        return file.read().split("\n")


def blocks(page):
    """The fenced blocks: (number of the first line, info string, lines)."""
    found, block = [], None
    for number, line in enumerate(lines_of(page), 1):
        fence = FENCE.match(line)
        if fence and block is None:
            block = (number + 1, fence[2].strip(), [])
        elif fence:
            found.append(block)
            block = None
        elif block is not None:
            block[2].append(line)
    return found


def prose(page):
    """The lines outside fenced blocks: (number, line)."""
    inside = False
    for number, line in enumerate(lines_of(page), 1):
        if FENCE.match(line):
            inside = not inside
        elif not inside:
            yield number, line


# Links

def slug(title):
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")


@functools.lru_cache(maxsize=None)
def anchors(page):
    return {slug(line.lstrip("#")) for _, line in prose(page) if re.match(r"#+ ", line)}


def link_faults(page):
    for number, line in prose(page):
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            file = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            if not os.path.exists(os.path.join(ROOT, file)):
                yield f"{page}:{number}: {target}: there is no {file}"
            elif page.startswith("docs/") and not file.startswith("docs/"):
                yield f"{page}:{number}: {target} leads out of the site"
            elif anchor and anchor not in anchors(file):
                yield f"{page}:{number}: {target}: {file} has no title of that name"


def site_faults(page):
    """What Python-Markdown, which makes the site, reads otherwise than GitHub."""
    before = ""
    for number, line in prose(page):
        item, follows = (re.match(r"([-*]|\d+\.) \S", text) for text in (line, before))
        if item and before.strip() and not follows and not re.match(r"\s", before):
            yield f"{page}:{number}: a list needs an empty line above it"
        if line.startswith("#") and "](" in line:
            yield f"{page}:{number}: a title without links, or it has another anchor on the site"
        before = line
    for number, info, _ in blocks(page):
        if lines_of(page)[number - 2].startswith(" "):
            yield f"{page}:{number}: a fenced block begins at the line's start"
        if not re.match(r"(sh( no-run)?|cpp|json|python|text|xml)?$", info):
            yield f"{page}:{number}: a block is sh, sh no-run, cpp, json, python, xml or text, not '{info}'"


# Commands

class Program:
    """The commands, options and parameters that vesselbench knows, by its own help."""

    def __init__(self, path):
        self.path = path

    @functools.lru_cache(maxsize=None)
    def help(self, *arguments):
        done = subprocess.run([self.path, *arguments], capture_output=True, text=True)
        return done.stdout if done.returncode == 0 else ""

    def options(self, *command):
        return HIDDEN | set(re.findall(r"(?:^|[\s,])(--?[a-z][\w-]*)", self.help(*command, "--help"), re.M))

    @functools.lru_cache(maxsize=None)
    def commands(self):
        return set(re.findall(r"^  ([a-z]+) ", self.help("--help").split("Subcommands:")[1], re.M))

    @functools.lru_cache(maxsize=None)
    def operations(self):
        """The parameters of each operation; openfoam's are those that `export` names."""
        flow = re.search(r"--set openfoam\.([\w,\s]+);", self.help("export", "--help"))
        found = {"openfoam": set(re.findall(r"\w+", flow[1])) if flow else set()}
        for operation in json.loads(self.help("operations", "--json"))["operations"]:
            found[operation["name"]] = {parameter["name"] for parameter in operation["parameters"]}
        return found

    def fault(self, words):
        """What is wrong with the words of a command after `vesselbench`, or None."""
        command = words[0] if words and not words[0].startswith("-") else None
        if command is None:
            return self.unknown_options(words, self.options())
        if command not in self.commands():
            return f"there is no command '{command}'"
        return (self.unknown_options(words[1:], self.options(command)) or self.unknown_settings(words)
                or (self.unknown_parameter(words[2], words[3:]) if command == "apply" and len(words) > 2 else None)
                or (self.unknown_operation(words[1]) if command == "operations" and len(words) > 1 else None))

    @staticmethod
    def unknown_options(words, known):
        wrong = [word for word in words if word.startswith("-") and word.split("=")[0] not in known]
        return f"there is no option '{wrong[0]}'" if wrong else None

    def unknown_operation(self, name):
        if not name.startswith("-") and name not in self.operations():
            return f"there is no operation '{name}'"
        return None

    def unknown_parameter(self, operation, words):
        names = [word.split("=")[0] for word in words if re.match(r"[a-z_]+=", word)]
        wrong = [name for name in names if name not in self.operations().get(operation, names)]
        return self.unknown_operation(operation) or (f"'{operation}' has no parameter '{wrong[0]}'" if wrong else None)

    def unknown_settings(self, words):
        settings = [after for word, after in zip(words, words[1:]) if word == "--set"]
        for operation, _, argument in (setting.partition(".") for setting in settings):
            fault = self.unknown_parameter(operation, [argument])
            if fault:
                return fault
        return None


def script_fault(script, words):
    """Options of our own scripts stand in their texts."""
    path = os.path.join(ROOT, script)
    if not os.access(path, os.X_OK):
        return f"there is no script {script}"
    with open(path) as file:
        text = file.read()
    wrong = [word for word in words if word.startswith("--") and word.split("=")[0] not in text]
    return f"{script} has no option '{wrong[0]}'" if wrong else None


def command_fault(line, program):
    """What is wrong with a line of a shell block, or None."""
    for part in re.split(r"&&|\|\||;|\|", re.sub(r"\s#.*$", "", line)):
        match = COMMAND.match(part.strip())
        if match:
            words = shlex.split(part.strip()[match.end():])
            fault = program.fault(words) if match[1] == "vesselbench" else script_fault(match[1], words)
            if fault:
                return fault
    return None


def code_faults(page, program):
    """Commands in running text: `vesselbench log P`. What a reader fills in is in capitals or cut off by dots."""
    text = "\n".join(line for _, line in prose(page))
    for code in re.findall(r"(?<!`)`([^`]+)`(?!`)", text):
        words = re.sub(r"\s+", " ", code)
        if COMMAND.match(words):
            fault = command_fault(re.sub(r"\s*\.\.\.", "", words), program)
            if fault and not re.search(r"'[A-Z]+'", fault):
                yield f"{page}: `{words}`: {fault}"


def block_faults(page, program):
    for number, info, lines in blocks(page):
        if info.split(" ")[0] != "sh":
            continue
        for offset, line in enumerate(lines):
            fault = command_fault(line, program)
            if fault:
                yield f"{page}:{number + offset}: {fault}: {line.strip()}"
    for number, line in prose(page):
        if re.match(r"\s{4,}", line) and COMMAND.match(line.strip()):
            yield f"{page}:{number}: a command outside a block ```sh: {line.strip()}"


# Running

# Runs blocks of Python, [[place, text], ...], as one script whose traceback names their places.
PYTHON = """
import json, sys
names = {"__name__": "__main__"}
for place, text in json.load(sys.stdin):
    exec(compile(text, place, "exec"), names)
"""


def python_faults(page, folder, environment):
    """The lines before a block keep the page's line numbers in tracebacks."""
    texts = [(page, "\n" * (number - 1) + "\n".join(lines)) for number, info, lines in blocks(page) if info == "python"]
    if not texts:
        return []
    done = subprocess.run([sys.executable, "-c", PYTHON], input=json.dumps(texts), cwd=folder, text=True,
                          env=dict(environment, PYTHONPATH=os.path.join(common.ROOT, "packaging", "python")),
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    return [f"{page}: {done.stderr.strip()}"] if done.returncode != 0 else []


def run_faults(page, program, prepared):
    """Runs the blocks of a page one after the other, with the page's folder as the current one."""
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(prepared, folder, dirs_exist_ok=True)
        environment = dict(os.environ, PATH=os.path.dirname(program.path) + ":" + os.environ["PATH"],
                           VESSELBENCH=program.path)
        for number, info, lines in blocks(page):
            if info != "sh":
                continue
            text = "\n".join(line for line in lines if line.split(" #")[0].strip() != PREPARED)
            done = subprocess.run(["bash", "-e", "-c", text], cwd=folder, env=environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if done.returncode != 0:
                faults.append(f"{page}:{number}: exit code {done.returncode}\n" + "\n".join(done.stdout.split("\n")[-8:]))
        return faults + python_faults(page, folder, environment)


def run(program, chosen):
    with tempfile.TemporaryDirectory() as prepared:
        subprocess.run([program.path, *PREPARED.split()[1:]], cwd=prepared, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        wanted = chosen or [page for page in pages() if page == "README.md" or page.startswith("docs/user/")]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for faults in pool.map(lambda page: run_faults(page, program, prepared), wanted):
                yield from faults


# The site

QUESTIONS = {  # what users type into the search, and the page that answers it
    "inlet": "user/ends.html",
    "how do I choose the inlet": "user/ends.html",
    "install": "user/install.html",
    "print": "user/printing.html",
    "staircases": "user/smoothing.html",
    "DICOM": "user/formats.html",
    "exit code": "user/command-line.html",
    "python": "user/scripting.html",
}
# Runs the site's own search: search/worker.js with lunr, as a browser's worker does.
SEARCH = """
const fs = require('fs'), vm = require('vm'), folder = process.argv[1] + '/search/';
const read = (file) => fs.readFileSync(folder + file, 'utf8');
delete globalThis.exports;  // which lunr would take for its place
globalThis.importScripts = (...files) => files.forEach((file) => vm.runInThisContext(read(file)));
globalThis.console.log = () => {};
globalThis.XMLHttpRequest = class {
  addEventListener(_, loaded) { this.loaded = loaded; }
  open(_, file) { this.responseText = read(file); }
  send() { this.loaded(); }
};
let answer;
globalThis.postMessage = (message) => { answer = message.results; };
importScripts('worker.js');
onmessage({ data: { init: true } });
const ask = (query) => { onmessage({ data: { query } }); return answer.map((page) => page.location); };
process.stdout.write(JSON.stringify(JSON.parse(process.argv[2]).map(ask)));
"""


def network_faults(site):
    """What a browser would load from elsewhere: links to follow are allowed, sources are not."""
    source = re.compile(r"""<(?:link|script|img|iframe)[^>]*?(?:href|src)=["']?(?:https?:)?//[^"'> ]+"""
                        r"""|url\(["']?(?:https?:)?//[^)]*|@import""")
    for folder, _, names in os.walk(site):
        for name in names:
            if name.endswith((".html", ".css")):
                with open(os.path.join(folder, name)) as file:
                    for found in source.findall(file.read()):
                        yield f"{os.path.relpath(os.path.join(folder, name), site)}: {found}"


def asset_faults(site):
    """What a page loads from the site has to be there: a theme may lack parts."""
    for folder, _, names in os.walk(site):
        for name in names:
            if name.endswith(".html") and name != "404.html":
                with open(os.path.join(folder, name)) as file:
                    for asset in re.findall(r'<(?:link|script|img)[^>]*?(?:href|src)="([^":?]+)', file.read()):
                        if not os.path.exists(os.path.join(folder, asset)):
                            yield f"{os.path.relpath(os.path.join(folder, name), site)}: there is no {asset}"


def disk_search_faults(site):
    """A page from the disk has the search, too, in a browser."""
    browser = os.environ.get("CHROMIUM") or shutil.which("chromium")
    if not browser:
        common.skip("no chromium")
        return
    for question, answer in list(QUESTIONS.items())[:2]:
        page = f"file://{site}/index.html?q={urllib.parse.quote(question)}"
        command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=20000", "--dump-dom", page]
        shown = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, timeout=120).stdout
        found = shown.partition('id="mkdocs-search-results"')[2].partition("</article></div>")[0]
        if f"/{answer}" not in found:
            yield f"search from the disk: '{question}' does not lead to {answer}"


def search_faults(site):
    """Every question's page has to be among the first three pages found."""
    done = subprocess.run(["node", "-e", SEARCH, site, json.dumps(list(QUESTIONS))], capture_output=True, text=True, check=True)
    for (question, answer), locations in zip(QUESTIONS.items(), json.loads(done.stdout)):
        first = list(dict.fromkeys(location.split("#")[0] for location in locations))[:3]
        if answer not in first:
            yield f"search: '{question}' leads to {', '.join(first)}, not to {answer}"


def site_build_faults():
    for tool in ("mkdocs", "node"):
        if not shutil.which(tool):
            common.skip(f"no {tool}")
            return []
    with tempfile.TemporaryDirectory() as site:
        done = subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--site-dir", site], cwd=ROOT, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            return [done.stdout.strip()]
        return [*network_faults(site), *asset_faults(site), *search_faults(site), *disk_search_faults(site)]


def literals(folder):
    """What the sources below a folder say, in one text of small letters: their string literals, with blanks for - and _."""
    found = []
    for place, _, names in sorted(os.walk(os.path.join(ROOT, folder))):
        for name in sorted(names):
            if name.endswith((".cpp", ".h")):
                with open(os.path.join(place, name)) as file:
                    found += re.findall(r'"((?:[^"\\\n]|\\.)*)"', file.read())
    return "\n".join(found).lower().replace("-", " ").replace("_", " ")


def picture_faults(pictures="docs/pictures", sources="workbench"):
    """A word on a picture of the window that the window no longer has: the picture is of an older one. labels.json beside the
    pictures has the words, as scripts/screenshots wrote them; numbers and names of files are left out."""
    with open(os.path.join(ROOT, pictures, "labels.json")) as file:
        labels = json.load(file)
    said = literals(sources)
    for picture, words in labels.items():
        if not os.path.exists(os.path.join(ROOT, pictures, picture + ".png")):
            yield f"{pictures}/labels.json: there is no {picture}.png"
        for label in words:
            for part in re.split(r"[^a-z' ]+", label.lower()):
                if len(part.strip()) > 2 and part.strip() not in said and "." not in label:
                    yield f"{pictures}/{picture}.png: the window no longer says '{label}'; make the picture again"
                    break


def faults_of(part, program, chosen):
    if part == "run":
        return list(run(program, chosen))
    if part == "site":
        return site_build_faults()
    if part == "pictures":
        return list(picture_faults())
    if part == "links":
        return [fault for page in pages() for fault in (*link_faults(page), *site_faults(page))]
    return [fault for page in pages() for fault in (*block_faults(page, program), *code_faults(page, program))]


def main():
    parser = common.parser(__doc__)
    parser.add_argument("part", choices=["links", "commands", "run", "site", "pictures"])
    parser.add_argument("--program", default=common.PROGRAM)
    parser.add_argument("pages", nargs="*")
    options = parser.parse_args()
    faults = faults_of(options.part, Program(os.path.abspath(options.program)), options.pages)
    print(*faults, sep="\n", end="\n" if faults else "")
    print(f"check_docs: {options.part}: {len(faults)} faults")
    return 1 if faults else 77 if common.skipped else 0


if __name__ == "__main__":
    sys.exit(main())
