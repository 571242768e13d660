"""Runs what the pages show: every block of C, C++, Fortran, Python and shell in README.md and docs/.

Usage: blocks.py ROOT LIBRARY_FOLDER TOOL

LIBRARY_FOLDER has libplanish.so, TOOL is the command line tool. Blocks of one language in one page make one program, in
order: C, C++ and Fortran are compiled (and run where they have a main program), Python and shell commands are run, in a
scratch folder with a sample mesh `part.stl`. A block marked `norun` is left out: it changes the machine.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

#: Programs that need a file run beside this sample.
SAMPLE = "part.stl"


def blocks(page):
    """(language, text) of each fenced block."""
    for info, text in re.findall(r"^```([\w,]*)\n(.*?)^```", page.read_text(), re.M | re.S):
        language, _, marks = info.partition(",")
        if marks != "norun":
            yield language, text


def run(arguments, folder, **environment):
    done = subprocess.run(
        arguments, cwd=folder, env={**os.environ, **environment}, capture_output=True, text=True, timeout=300
    )
    if done.returncode not in (0, 2) or (done.returncode == 2 and Path(arguments[0]).name != "bash"):
        raise RuntimeError(f"{' '.join(map(str, arguments))[:200]}: exit code {done.returncode}\n{done.stdout}{done.stderr}")


def python_with_numpy():
    """This Python, or the system's, whichever has numpy."""
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode == 0:
            return python
    raise RuntimeError("no Python has numpy")


class Runner:
    def __init__(self, root, library, tool, folder):
        self.root, self.library, self.tool, self.folder = root, library, tool, folder
        self.link = [f"-L{library}", "-lplanish", f"-Wl,-rpath,{library}", "-lm"]
        run([tool, "sample", "curved-notch", SAMPLE], folder)

    def c(self, text):
        self._compile("cc", "-std=c11", "c", text, "int main" in text)

    def cpp(self, text):
        self._compile("c++", "-std=c++17", "cpp", text, "int main" in text)

    def _compile(self, compiler, standard, ending, text, has_main):
        source = self.folder / f"block.{ending}"
        source.write_text(text)
        flags = [standard, "-Wall", "-Wextra", "-Werror", f"-I{self.root / 'include'}"]
        if has_main:
            run([compiler, *flags, source, "-o", "block", *self.link], self.folder)
            run([str(self.folder / "block")], self.folder)
        else:
            run([compiler, *flags, "-c", source, "-o", "block.o"], self.folder)

    def fortran(self, text):
        if not re.search(r"^\s*end( program.*)?\s*$", text, re.M):
            text += "end\n"  # a main program without a first statement
        source = self.folder / "block.f90"
        source.write_text(text)
        modules = [self.root / "bindings/planish_c.f90", self.root / "include/planish.f90"]
        run(["gfortran", "-std=f2018", *modules, source, "-o", "block", *self.link], self.folder)
        if re.search(r"^\s*program ", text, re.M):
            run([str(self.folder / "block")], self.folder)

    def python(self, text):
        source = self.folder / "block.py"
        source.write_text(text)
        library = str(self.library / "libplanish.so")
        run([python_with_numpy(), source], self.folder, PYTHONPATH=str(self.root / "python"), PLANISH_LIBRARY=library)

    def sh(self, text):
        path = f"{self.tool.parent}:{os.environ['PATH']}"
        run(["bash", "-c", text], self.folder, PATH=path)


def main(root, library, tool):
    failures = count = 0
    for page in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]:
        programs = {}
        for language, text in blocks(page):
            if language in ("c", "cpp", "fortran", "python", "sh"):
                programs.setdefault(language, []).append(text)
        for language, texts in programs.items():
            # C, C++ and Fortran blocks are whole programs each; the others go on where the last one ended
            for text in texts if language in ("c", "cpp", "fortran") else ["".join(texts)]:
                count += 1
                with tempfile.TemporaryDirectory() as folder:
                    try:
                        getattr(Runner(root, library, tool, Path(folder)), language)(text)
                    except Exception as error:
                        failures += 1
                        print(f"{page.relative_to(root)}, {language}: {error}", file=sys.stderr)
    print(f"{count} programs of the pages, {failures} failed")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main(*(Path(argument).resolve() for argument in sys.argv[1:4])))
