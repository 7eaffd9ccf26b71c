#!/usr/bin/env python3
"""draws_in_order.py FILE...: proves that no expression draws two random numbers in an order that the compiler chooses.

C++ leaves open in which order the arguments of a call in parentheses, and the operands of most operators, are
evaluated: g++ 12 and clang 14 differ. Where two of them draw from a generator, the program's answer is the
compiler's choice. Braces, ';', '&&', '||', '?:', '=' and '<<' do order what stands about them.

A draw is a call of a Pcg32's member, a call that is given a Pcg32, or a call of a lambda that draws.
Prints each fault as file:line: what; fails if there are any.
"""
import re
import sys

TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\])*"|\d[\w.\']*|\'(?:\\.|[^\'\\])*\'|[A-Za-z_]\w*|'
    r"::|->|\+\+|--|<=>|<<=|>>=|[-+*/%&|^=!<>]=|&&|\|\||<<|#[^\n]*|\S", re.S)
CLOSING = {"(": ")", "[": "]", "{": "}"}
UNORDERED = {"+", "-", "*", "/", "%", "<", ">", "<=", ">=", "==", "!=", "<=>", "&", "|", "^"}
ORDERING = {";", ",", "&&", "||", "?", ":", "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<", "<<=", ">>=",
            "return"}
NO_CALL = {"if", "while", "for", "switch", "catch", "return", "sizeof", "decltype", "noexcept", "requires"}


class Group:
    """What stands between two brackets, and between them."""

    def __init__(self, opening, line):
        self.opening, self.line, self.items = opening, line, []


def parsed(text):
    """The file as nested groups of (token, line)."""
    stack = [Group("{", 1)]
    for match in TOKEN.finditer(text):
        token, line = match.group(), text.count("\n", 0, match.start()) + 1
        if token.startswith(("//", "/*", "#")):
            continue
        if token in CLOSING:
            stack.append(Group(token, line))
        elif token in CLOSING.values():
            if len(stack) > 1 and CLOSING[stack[-1].opening] == token:
                group = stack.pop()
                stack[-1].items.append(group)
        else:
            stack[-1].items.append((token, line))
    return stack[0]


def is_group(item, opening):
    return isinstance(item, Group) and item.opening == opening


def word(item):
    return item[0] if isinstance(item, tuple) else ""


def is_name(item):
    return bool(re.match(r"[A-Za-z_]", word(item)))


class Reader:
    def __init__(self, file):
        self.file, self.faults = file, []

    def generator_in(self, items):
        """The name of a Pcg32 (or of a reference to one) that is declared in these items at their own level."""
        names = set()
        for i, item in enumerate(items):
            if word(item) == "Pcg32":
                j = i + 1
                if j < len(items) and word(items[j]) == "&":
                    j += 1
                if j < len(items) and is_name(items[j]):
                    names.add(word(items[j]))
        return names

    def body_of_lambda(self, items, i):
        """Where items[i] begins a lambda: the index of its body."""
        if not is_group(items[i], "[") or (i > 0 and (is_name(items[i - 1]) and word(items[i - 1]) != "return"
                                                      or isinstance(items[i - 1], Group))):
            return None
        j = i + 1
        if j < len(items) and is_group(items[j], "("):
            j += 1
        while j < len(items) and not isinstance(items[j], Group) and word(items[j]) not in (";", ","):
            j += 1  # mutable, -> type
        return j if j < len(items) and is_group(items[j], "{") else None

    def parameters(self, items, i, body):
        return items[i + 1].items if body > i + 1 and is_group(items[i + 1], "(") else []

    def fault(self, line, what):
        self.faults.append(f"{self.file}:{line}: {what}")

    def draws(self, group, generators, drawing, kind):
        """Whether evaluating the group draws; kind: "arguments", "block" or "expression"."""
        generators, drawing = set(generators), set(drawing)
        generators |= self.generator_in(group.items)
        arguments_that_draw = operands_that_draw = 0
        argument = operand = anything = False
        items, i, line = group.items, 0, group.line
        while i < len(items):
            item = items[i]
            if isinstance(item, tuple):
                line = item[1]
            body = self.body_of_lambda(items, i) if isinstance(item, Group) else None
            if body is not None:
                within = generators | self.generator_in(self.parameters(items, i, body))
                does = self.draws(items[body], within, drawing, "block")
                called = body + 1 < len(items) and is_group(items[body + 1], "(")
                if does and i >= 2 and word(items[i - 1]) == "=" and is_name(items[i - 2]) and not called:
                    if within == generators:  # captured; one that is given a generator is seen where it is called
                        drawing.add(word(items[i - 2]))
                operand = operand or does and called
                i = body + (2 if called else 1)
                if kind == "block" and i < len(items) and word(items[i]) != ";":
                    continue
                continue
            if isinstance(item, Group):
                before = items[i - 1] if i else None
                calls = (is_name(before) and word(before) not in NO_CALL or word(before) == ">" or
                         isinstance(before, Group)) if before else False
                if item.opening == "(":
                    does = self.draws(item, generators, drawing, "arguments" if calls else "expression")
                    if calls and self.is_draw(items, i, generators, drawing):
                        does = True
                    # A function's parameters declare generators for its body.
                    declared = self.generator_in(item.items)
                    if declared:
                        self.of_next_body = declared
                elif item.opening == "[":
                    does = self.draws(item, generators, drawing, "expression")
                else:
                    statement = kind == "block" and before is not None and (
                        is_group(before, "(") or word(before) in ("else", "do", "try", "const", "noexcept", "override"))
                    within = generators | (getattr(self, "of_next_body", set()) if statement else set())
                    does = self.draws(item, within, drawing, "block")
                    if statement:
                        self.of_next_body = set()
                        anything = anything or does or operand
                        operand, operands_that_draw = False, 0
                        i += 1
                        continue
                operand = operand or does
            elif word(item) in UNORDERED or word(item) in ORDERING:
                operands_that_draw += operand
                anything, argument, operand = anything or operand, argument or operand, False
                if operands_that_draw == 2:
                    self.fault(line, "two operands draw, in an order that the compiler chooses")
                if word(item) in ORDERING:
                    operands_that_draw = 0
                if word(item) == ",":
                    arguments_that_draw += argument
                    argument = False
            i += 1
        operands_that_draw += operand
        anything, argument = anything or operand, argument or operand
        if operands_that_draw == 2:
            self.fault(line, "two operands draw, in an order that the compiler chooses")
        if kind == "arguments" and arguments_that_draw + argument > 1:
            self.fault(group.line, "two arguments of a call draw, in an order that the compiler chooses")
        return anything

    def is_draw(self, items, i, generators, drawing):
        """Whether the call whose arguments are items[i] draws by itself."""
        if word(items[i - 1]) in drawing and (i < 2 or word(items[i - 2]) not in (".", "->", "::")):
            return True
        if i >= 3 and word(items[i - 2]) == "." and word(items[i - 3]) in generators:
            return True
        given = items[i].items
        return any(word(item) in generators and (j == 0 or word(given[j - 1]) == ",") and
                   (j + 1 == len(given) or word(given[j + 1]) == ",") for j, item in enumerate(given))


def main():
    faults = []
    for file in sys.argv[1:]:
        reader = Reader(file)
        with open(file, encoding="utf-8") as text:
            reader.draws(parsed(text.read()), set(), set(), "block")
        faults += sorted(set(reader.faults), key=lambda fault: int(fault.split(":")[1]))
    print("\n".join(faults)) if faults else None
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
