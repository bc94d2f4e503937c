#!/usr/bin/env python3
"""Fails if a function in src or parsers has more than 60 lines or more than 6 parameters.

A function's lines are those from its head to its closing brace; tables of data (a body without a statement other than a
returned or a static list) do not count. Reads the sources as text: they are formatted by clang-format, so a function
body begins with a line that ends in "{" and ends at the brace that closes it.

    scripts/check_functions.py [FILE …]     all sources, or these
"""
import pathlib
import re
import sys

MOST_LINES = 60
MOST_PARAMETERS = 6
KEYWORDS = {"if", "for", "while", "switch", "catch", "return", "sizeof", "alignof", "decltype", "requires",
            "static_assert", "noexcept", "explicit", "alignas", "new", "throw", "operator"}


def blanked(text):
    """The text with comments, literals and preprocessor lines replaced by blanks, line by line as long as before."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    return re.sub(r'//[^\n]*|/\*.*?\*/|R"(\w*)\((?:.|\n)*?\)\1"|"(?:\\.|[^"\\\n])*"'
                  r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*",
                  blank, text, flags=re.S | re.M)


def closing(text, at, pair):
    """Where the bracket at `at` is closed."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] == pair[0]) - (text[i] == pair[1])
        if depth == 0:
            return i
    return len(text)


def parameters(text):
    """The number of parameters in what stands between the brackets of a function's head."""
    if text.strip() in ("", "void"):
        return 0
    text = re.sub(r"->|<=|>=|<<|>>=", "  ", text)
    depth = count = 0
    for c in text:
        depth += (c in "(<{[") - (c in ")>}]")
        count += c == "," and depth == 0
    return count + 1


# What may stand between the parameters of a definition and its body or its initialisers.
TAIL = re.compile(r"\s*(?:const|noexcept(?:\([^()]*\))?|override|final|&|mutable|->\s*[\w:<>,&*\s]+?|\s)*(?P<end>[{:])")
HEAD = re.compile(r"(?P<name>~?[A-Za-z_]\w*|operator\s*(?:\(\)|\[\]|[^\s\w(]+)|\])\s*\(")
INITIALISER = re.compile(r"\s*[\w:<>]+\s*(?P<open>[({])")


def body(code, at, end):
    """Where the body of a definition begins whose parameters are followed by `end` at `at`; None for other things."""
    if end == "{":
        return at
    if code[at + 1] == ":":  # a qualified name
        return None
    at += 1
    while True:
        member = INITIALISER.match(code, at)
        if not member:
            return None
        at = closing(code, member.end() - 1, "()" if member.group("open") == "(" else "{}") + 1
        after = re.match(r"\s*(?:\.\.\.\s*)?([,{])", code[at:])
        if not after:
            return None
        at += after.end()
        if after.group(1) == "{":
            return at - 1


def is_table(body):
    """Whether a body only returns or names lists of data."""
    statements = re.sub(r"\{[^{}]*\}", "{}", body)
    previous = None
    while previous != statements:
        previous, statements = statements, re.sub(r"\{[{}\s,\w.:<>()&*+|!-]*\}|\([^()]*\)", "", statements)
    return statements.count(";") <= 2


def functions(text):
    """(name, line of the head, lines of the whole, parameters, is a table) of each definition, lambdas among them."""
    code = blanked(text)
    for head in HEAD.finditer(code):
        if head.group("name") in KEYWORDS:
            continue
        end = closing(code, head.end() - 1, "()")
        tail = TAIL.match(code, end + 1)
        start = tail and body(code, tail.end() - 1, tail.group("end"))
        if not start:
            continue
        last = closing(code, start, "{}")
        yield (head.group("name"), code.count("\n", 0, head.start()) + 1, code.count("\n", head.start(), last) + 1,
               parameters(code[head.end():end]), is_table(code[start + 1:last]))


def main(arguments):
    root = pathlib.Path(__file__).resolve().parent.parent
    files = [pathlib.Path(a).resolve() for a in arguments] or sorted(
        f for room in ("src", "parsers") for f in (root / room).rglob("*") if f.suffix in (".h", ".cpp"))
    faults = []
    for file in files:
        shown = str(file.relative_to(root) if file.is_relative_to(root) else file)
        for name, line, lines, count, table in functions(file.read_text(encoding="utf8")):
            larger = [f"{lines} lines; {MOST_LINES} are enough"] if lines > MOST_LINES and not table else []
            larger += [f"{count} parameters; {MOST_PARAMETERS} are enough"] if count > MOST_PARAMETERS else []
            faults += [f"{shown}:{line}: {name} has {what}" for what in larger]
    print("\n".join(faults), end="\n" if faults else "")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
