#!/usr/bin/env python3
"""Runs the blocks of one Markdown page, and compares what they print with what the page shows.

  run_blocks.py PAGE --source FOLDER --talus COMMAND [--library FILE --compiler CC --flag F ...]
  run_blocks.py PAGE --mend ...       and writes what the commands print now into the page, and the pictures that they draw
                                      into docs/images: to be looked at before they are kept

Each page gets one empty folder; its blocks run there in order. By the language of the fence:

  console   `$ command` lines, each followed by what it prints. A command that prints something else is a fault. One that
            shows nothing may print anything, but must succeed; one that fails must show its message.
  sh        commands without their output; each line must succeed. `make` stands for `make -n` at the top of the
            sources: the targets must exist. `cc` stands for the compiler and the flags of the build.
  c         a whole program (it has a main) is compiled, linked and run, and must return 0; a fragment is compiled
            inside of a function, with warnings as errors. With a main in the source around it, it is a program too.
  cmake     is configured and built as the CMakeLists.txt of a project of its own.
  text, json   are not run. No other language is allowed.

When outputs are compared, runs of blanks count as one, and every duration (a number and ns, us, ms or s, or the last
number of a table's line under `ms`) as the same. A line `...` stands for any lines.

A picture of docs/images that the page shows, and of whose name the page's commands leave a file, must look like that file.

A comment right before a block tells what a reader need not see:

  <!-- test: setup COMMANDS -->    shell commands that make the files which the page takes for granted
  <!-- test: given CODE -->        what a fragment takes for granted: declarations before it, in the same function
  <!-- test: wrap CODE -->         the source around a fragment; the line @ stands for it
  <!-- test: continued -->         the fragment goes on where the one before it ended
  <!-- test: file NAME -->         the block is also written to that file, for commands after it
  <!-- test: output -->            a text block is what the program before it prints
  <!-- test: answer may be no -->  the last command may end with exit code 1, which says no
  <!-- test: not run, REASON -->   the block is left alone
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

import pictures

LANGUAGES = ("console", "sh", "c", "cmake", "text", "json")
INCLUDES = "#include <talus/talus.h>\n" + "".join(
    f"#include <{name}.h>\n" for name in ("math", "stdbool", "stdint", "stdio", "stdlib", "string"))
WARNINGS = ["-std=c17", "-Wall", "-Wextra", "-Werror", "-Wno-unknown-warning-option", "-Wno-unused-variable",
            "-Wno-unused-but-set-variable",
            "-Wno-unused-parameter", "-Wno-unused-function", "-Wno-unused-value", "-Wno-maybe-uninitialized", "-Wno-uninitialized"]
SHELL = """set -euo pipefail
make() { command make -n -C "$TALUS_SOURCE" "$@" >/dev/null; }
cc() { "$TALUS_CC" $TALUS_FLAGS "$@"; }
"""
DURATION = re.compile(r"\b\d+(\.\d+)? (ns|us|ms|s|seconds)\b")
TIMEOUT = 300
MAX_DETAIL = 3000


class Block:
    def __init__(self, line, language, notes):
        self.line, self.language, self.notes, self.lines = line, language, notes, []

    def text(self):
        return "\n".join(self.lines) + "\n"

    def note(self, kind):
        """What the comment of that kind says, or None."""
        return next((rest for word, rest in self.notes if word == kind), None)


def read_page(path):
    """The blocks of a page, each with the comments right before it; setups are blocks of their own."""
    blocks, notes, block, comment = [], [], None, None
    for number, line in enumerate(open(path, encoding="utf-8"), 1):
        line = line.rstrip("\n")
        if block is not None:
            if line.strip() == "```":
                blocks.append(block)
                block = None
            else:
                block.lines.append(line)
        elif comment is not None or line.startswith("<!-- test:"):
            comment = line[len("<!-- test:"):] if comment is None else comment + "\n" + line
            if comment.endswith("-->"):
                word, _, rest = comment[:-3].strip().replace("\n", " \n", 1).partition(" ")
                if word == "not":
                    word, rest = "not run", rest.partition(" ")[2]
                if word == "setup":
                    blocks.append(Block(number, "setup", []))
                    blocks[-1].lines = rest.strip().split("\n")
                else:
                    notes.append((word.rstrip(","), rest))
                comment = None
        elif line.startswith("```"):
            block = Block(number, line[3:].strip(), notes)
            notes = []
        elif line.strip():
            notes = []
    return blocks


def plain(text):
    """The text as it is compared: blanks run together, durations all the same."""
    lines = [re.sub(r"\s+", " ", DURATION.sub("TIME", line)).strip() for line in text.split("\n")]
    if any(line.endswith(" ms") for line in lines):
        lines = [re.sub(r" \d+\.\d+$", " TIME", line) for line in lines]
    return "\n".join(line for line in lines if line)


def agrees(shown, printed):
    pattern = "\n" + plain(shown) + "\n"
    parts = [re.escape(part) for part in pattern.split("\n...\n")]
    return re.fullmatch("\n(?:.*\n)?".join(parts), "\n" + plain(printed) + "\n", re.S) is not None


def commands_of(block):
    """Pairs of a command and what the page shows below it."""
    pairs = []
    for line in block.lines:
        if line.startswith("$ "):
            pairs.append([line[2:], ""])
        elif pairs and pairs[-1][0].endswith("\\"):
            pairs[-1][0] += "\n" + line
        elif pairs:
            pairs[-1][1] += line + "\n"
    return pairs


class Page:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.faults, self.count = 0, 0
        self.fragment, self.printed = "", ""
        self.mended = []  # (block, command, what the page shows, what is printed)
        environment = dict(os.environ, LC_ALL="C.UTF-8", TALUS_SOURCE=options.source, TALUS_BUILD=options.build or "")
        environment.update(TALUS_CC=options.compiler, TALUS_FLAGS=" ".join(options.flag))
        environment["PATH"] = os.path.dirname(options.talus) + os.pathsep + environment["PATH"]
        environment["PKG_CONFIG_PATH"] = os.path.join(folder, "prefix/lib/pkgconfig")
        self.environment = environment

    def fault(self, block, what, detail=""):
        self.faults += 1
        print(f"{self.options.page}:{block.line}: {what}\n{detail[:MAX_DETAIL]}".rstrip())

    def run(self, command):
        return subprocess.run(command, cwd=self.folder, env=self.environment, capture_output=True, text=True,
                              timeout=TIMEOUT, stdin=subprocess.DEVNULL)

    def shell(self, command):
        return self.run(["bash", "-c", SHELL + command])

    def run_setup(self, block):
        result = self.shell(block.text())
        if result.returncode:
            self.fault(block, "the setup failed", result.stdout + result.stderr)

    def run_console(self, block):
        pairs = commands_of(block)
        if not pairs:
            self.fault(block, "a console block without a command")
        for command, shown in pairs:
            self.count += 1
            result = self.shell(command)
            printed = result.stdout + result.stderr
            if shown.strip() and not agrees(shown, printed):
                self.mended.append((block, command, shown, printed))
                self.fault(block, f"$ {command}", f"--- the page shows\n{shown}--- it prints\n{printed}")
            elif result.returncode and not shown.strip():
                self.fault(block, f"$ {command}", f"exit code {result.returncode}\n{printed}")

    def run_sh(self, block):
        self.count += 1
        result = self.shell(block.text())
        if result.returncode > (0 if block.note("answer") is None else 1):
            self.fault(block, f"the commands end with {result.returncode}", result.stdout + result.stderr)

    def compile(self, source, *arguments):
        path = os.path.join(self.folder, "block.c")
        with open(path, "w", encoding="utf-8") as file:
            file.write(source)
        include = ["-I" + os.path.join(self.options.source, name) for name in ("include", "src", "test/support", ".")]
        return self.run([self.options.compiler, *self.options.flag, *WARNINGS, *include, path, *arguments])

    def fragment_source(self, block):
        given = block.note("given") or ""
        body = "\n".join("" if line.strip() == "..." else line for line in block.lines)
        if block.note("wrap"):
            return INCLUDES + (block.note("wrap") + "\n").replace("\n@\n", "\n" + body + "\n")
        lines = given.split("\n") + body.split("\n")
        heads = [line for line in lines if line.startswith("#include")]
        rest = [line for line in lines if not line.startswith("#include")]
        before = self.fragment if block.note("continued") is not None else ""
        self.fragment = before + "\n".join(rest) + "\n"
        return INCLUDES + "\n".join(heads) + "\nvoid example(void);\nvoid example(void)\n{\n" + self.fragment + "}\n"

    def run_c(self, block):
        self.count += 1
        source = block.text()
        if not re.search(r"\bint main\(", source):
            source = self.fragment_source(block)
        if not re.search(r"\bint main\(", source):
            result = self.compile(source, "-fsyntax-only")
            if result.returncode:
                self.fault(block, "the fragment does not compile", result.stderr)
            return
        program = os.path.join(self.folder, "block")
        result = self.compile(source, self.options.library, "-lm", "-o", program)
        if result.returncode:
            self.fault(block, "the program does not compile", result.stderr)
            return
        result = self.run([program])
        self.printed = result.stdout + result.stderr
        if result.returncode:
            self.fault(block, f"the program returns {result.returncode}", self.printed)

    def run_cmake(self, block):
        self.count += 1
        project = os.path.join(self.folder, "project")
        shutil.rmtree(project, ignore_errors=True)
        os.mkdir(project)
        with open(os.path.join(project, "CMakeLists.txt"), "w", encoding="utf-8") as file:
            file.write("cmake_minimum_required(VERSION 3.16)\nproject(page C)\n" + (block.note("given") or "") + "\n")
            file.write(block.text())
        for command in (["cmake", "-S", project, "-B", project + "/build", "-DCMAKE_C_COMPILER=" + self.options.compiler,
                         "-DCMAKE_C_FLAGS=" + " ".join(self.options.flag),
                         "-DCMAKE_PREFIX_PATH=" + os.path.join(self.folder, "prefix")],
                        ["cmake", "--build", project + "/build"]):
            result = self.run(command)
            if result.returncode:
                self.fault(block, " ".join(command[:2]), result.stdout + result.stderr)
                return

    def run_text(self, block):
        if block.note("output") is not None:
            self.count += 1
            if not agrees(block.text(), self.printed):
                self.fault(block, "the program prints something else", self.printed)

    def compare_pictures(self):
        """Those of the page that its commands have drawn; with --mend they are taken over."""
        text = open(self.options.page, encoding="utf-8").read()
        for target in sorted(set(re.findall(r"!\[[^\]]*\]\(([^()\s]*images/[^()\s]+\.png)\)", text))):
            drawn = os.path.join(self.folder, os.path.basename(target))
            kept = os.path.join(os.path.dirname(os.path.abspath(self.options.page)), target)
            if not os.path.exists(drawn):
                continue
            self.count += 1
            why = pictures.differ(drawn, kept) if os.path.exists(kept) else "there is no such file"
            if why and self.options.mend:
                os.makedirs(os.path.dirname(kept), exist_ok=True)
                shutil.copyfile(drawn, kept)
                print(f"{self.options.page}: {target} drawn again ({why})")
            elif why:
                self.faults += 1
                print(f"{self.options.page}: {target} is not what the page's commands draw: {why}")

    def run_block(self, block):
        if block.note("file"):
            with open(os.path.join(self.folder, block.note("file").strip()), "w", encoding="utf-8") as file:
                file.write(block.text())
        if block.note("not run"):
            print(f"{self.options.page}:{block.line}: not run, {block.note('not run').strip()}")
        elif block.language == "setup":
            self.run_setup(block)
        elif block.language not in LANGUAGES:
            self.fault(block, f"a block of language '{block.language}'; it must be one of: {', '.join(LANGUAGES)}")
        elif block.language != "json":
            getattr(self, "run_" + block.language)(block)


def mend(page, mended):
    """Writes what commands print into the page; where it leaves lines out by `...` that is a person's work."""
    text = open(page, encoding="utf-8").read()
    for block, command, shown, printed in mended:
        old, new = f"$ {command}\n{shown}", f"$ {command}\n{printed.rstrip()}\n"
        if "\n...\n" not in "\n" + shown and text.count(old) == 1:
            text = text.replace(old, new)
        else:
            print(f"{page}:{block.line}: not mended: $ {command}")
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page")
    parser.add_argument("--source", required=True)
    parser.add_argument("--build")
    parser.add_argument("--talus", required=True)
    parser.add_argument("--library")
    parser.add_argument("--compiler", default="cc")
    parser.add_argument("--mend", action="store_true", help="write what commands print into the page")
    parser.add_argument("--flag", action="append", default=[])
    options = parser.parse_args()
    blocks = read_page(options.page)
    folder = tempfile.mkdtemp(prefix="talus_docs_")
    page = Page(options, folder)
    try:
        for block in blocks:
            page.run_block(block)
        page.compare_pictures()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    if options.mend:
        mend(options.page, page.mended)
    print(f"{page.count} blocks and commands, {page.faults} faults")
    sys.exit(1 if page.faults else 0)


main()
