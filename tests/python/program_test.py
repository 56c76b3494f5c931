"""Finding the program, its failures, and stopping it."""
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from unittest import mock

import vesselbench
from support import PROGRAM, InFolder


PATIENCE = 120.0  # seconds, for a machine that is busy


class Finding(InFolder):
    def test_the_argument_goes_before_the_variable_and_that_before_the_path(self):
        first = self.stand_in("echo vesselbench 1", "first")
        second = self.stand_in("echo vesselbench 2", "second")
        self.stand_in("echo vesselbench 3", "vesselbench")
        self.set_variable("PATH", f"{self.folder}:{os.environ['PATH']}")
        self.set_variable("VESSELBENCH", second)
        self.assertEqual(vesselbench.version(program=first), "1")
        self.assertEqual(vesselbench.version(), "2")
        self.set_variable("VESSELBENCH", None)
        self.assertEqual(vesselbench.version(), "3")

    def test_a_program_that_is_not_there_is_named_with_who_named_it(self):
        with self.assertRaisesRegex(vesselbench.ProgramNotFound, "'none/vesselbench', as the argument program says"):
            vesselbench.version(program="none/vesselbench")
        self.set_variable("VESSELBENCH", "/none")
        with self.assertRaisesRegex(vesselbench.ProgramNotFound, "'/none', as the environment variable VESSELBENCH says"):
            vesselbench.version()
        self.set_variable("VESSELBENCH", None)
        self.set_variable("PATH", self.folder)
        with self.assertRaisesRegex(vesselbench.ProgramNotFound, "no vesselbench in the PATH: install it"):
            vesselbench.version()

    def test_a_file_that_is_no_program(self):
        file = self.stand_in("", "file")
        file.write_bytes(b"\x7fELF nothing")
        with self.assertRaisesRegex(vesselbench.ProgramNotFound, "cannot be run: Exec format error"):
            vesselbench.version(program=file)


class Answers(InFolder):
    def test_what_is_no_json_document(self):
        for script in ("echo hello", "echo '[]'", "true", "echo '{' >&2; exit 1", "printf '\\377\\376'"):
            with self.subTest(script), self.assertRaisesRegex(vesselbench.UnexpectedAnswer, "printed no JSON document"):
                vesselbench.measure("a.stl", program=self.stand_in(script))

    def test_a_document_of_another_program(self):
        with self.assertRaisesRegex(vesselbench.UnexpectedAnswer, "measure has no 'vertices'"):
            vesselbench.measure("a.stl", program=self.stand_in("echo '{}'"))
        with self.assertRaisesRegex(vesselbench.UnexpectedAnswer, "operations is None"):
            vesselbench.operations(program=self.stand_in("echo '{}'"))
        with self.assertRaisesRegex(vesselbench.UnexpectedAnswer, "printed no version"):
            vesselbench.version(program=self.stand_in("true"))

    def test_the_command_line_is_logged(self):
        with self.assertLogs("vesselbench", "DEBUG") as logged:
            vesselbench.run("log", "a b.vbench", program=self.stand_in("echo '{}'"))
        self.assertRegex(logged.output[0], r"stand-in' log --json -- 'a b.vbench'$")

    def test_what_it_said_on_stderr_is_in_the_error(self):
        with self.assertRaisesRegex(vesselbench.UnexpectedAnswer, "no memory left"):
            vesselbench.measure("a.stl", program=self.stand_in("echo no memory left >&2; exit 1"))

    def test_a_program_that_is_killed(self):
        with self.assertRaisesRegex(vesselbench.VesselbenchError, "ended by signal 9") as caught:
            vesselbench.measure("a.stl", program=self.stand_in("kill -9 $$"))
        self.assertIsNone(caught.exception.exit_code)

    def test_a_program_that_others_stop(self):
        script = "echo '{\"error\": \"stopped\", \"code\": 1, \"cancelled\": true}'; exit 1"
        with self.assertRaisesRegex(vesselbench.Cancelled, "stopped"):
            vesselbench.measure("a.stl", program=self.stand_in(script))

    def test_a_lot_of_output_and_errors_does_not_block(self):
        script = "head -c 300000 /dev/zero >&2; echo '{\"x\": \"'; head -c 300000 /dev/zero | tr '\\0' a; echo '\"}'"
        with self.assertRaises(vesselbench.UnexpectedAnswer):  # a text has no ends of lines
            vesselbench.run("log", program=self.stand_in(script))


def descendants(process):
    """Ids of the processes that it started, and those that they started."""
    children = []
    for task in Path(f"/proc/{process}/task").glob("*/children"):
        children += map(int, task.read_text().split())
    return children + [one for child in children for one in descendants(child)]


def is_running(process):
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


def wait_for(what, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while not what():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.01)


class Interrupted(InFolder):

    def interrupt(self, script, program, started, send=os.kill):
        """Runs lines of Python until `started`, interrupts them. Returns their exit code and what the program had started."""
        python = subprocess.Popen([sys.executable, "-c", script], env=os.environ | {"VESSELBENCH": str(program)},
                                  stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            wait_for(started)
            below = descendants(python.pid)
            send(python.pid, signal.SIGINT)
            return python.wait(PATIENCE), below
        finally:
            python.kill()
            python.wait()

    def test_the_program_and_its_workers_end(self):
        """A notebook's kernel gets the signal alone; a terminal sends it to the program as well."""
        vesselbench.phantom("tube", "tube")
        for send in (os.kill, os.killpg):
            with self.subTest(send.__name__):
                script = f"import vesselbench; vesselbench.prepare('tube', 'cfd', '{send.__name__}')"
                code, below = self.interrupt(script, PROGRAM, Path(send.__name__, "project.vbench").exists, send)
                self.assertEqual(code, -signal.SIGINT)  # how Python ends by KeyboardInterrupt
                self.assertTrue(below)
                wait_for(lambda: not any(map(is_running, below)))

    def test_a_program_that_is_just_starting_ends(self):
        started = []

        class Interrupting(subprocess.Popen):
            def __init__(self, *words, **options):
                super().__init__(*words, **options)
                started.append(self)
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(0)  # where Python handles it

        program = self.stand_in("while :; do sleep 0.05; done")
        with mock.patch("subprocess.Popen", Interrupting), self.assertRaises(KeyboardInterrupt):
            vesselbench.measure("a.stl", program=program)
        self.assertEqual(started[0].returncode, -signal.SIGTERM)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_a_program_that_does_not_stop_is_killed(self):
        program = self.stand_in("trap '' TERM; touch started; while :; do sleep 0.05; done")
        script = "import vesselbench.program as p; p.STOP_SECONDS = 0.2; import vesselbench; vesselbench.measure('a')"
        code, below = self.interrupt(script, program, lambda: Path("started").exists())
        self.assertEqual(code, -signal.SIGINT)
        self.assertTrue(below)
        wait_for(lambda: not any(map(is_running, below)))
