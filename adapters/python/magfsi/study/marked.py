# SPDX-License-Identifier: GPL-2.0-or-later
"""YAML whose every value knows its place in the file, so that errors can name it."""
import difflib
import re

import yaml

PERCENT = re.compile(r"([0-9.eE+-]+)\s*%$")


class InputError(Exception):
    """Bad input; its text is one line: what was found, what is allowed."""


def _flow(node):
    """In one line, whatever style the file has."""
    if isinstance(node, yaml.CollectionNode):
        node.flow_style = True
        for child in node.value:
            for part in child if isinstance(child, tuple) else (child,):
                _flow(part)
    return node


class Value:
    """A node of the file. Reading it as what it should be either works or names the place."""

    def __init__(self, node, file, name):
        self.node, self.file, self.name = node, file, name

    def refuse(self, found, allowed):
        mark = self.node.start_mark
        raise InputError(f"{self.file}:{mark.line + 1}:{mark.column + 1}: {self.name}: "
                         f"found {found}; allowed {allowed}")

    def shown(self):
        return f'"{self.text()}"'

    def text(self):
        """As YAML in one line, spelled as in the file: what --set takes."""
        if isinstance(self.node, yaml.ScalarNode):
            return self.node.value
        return yaml.serialize(_flow(self.node), width=1e9).strip()

    def is_null(self):
        return self.node.tag == "tag:yaml.org,2002:null"

    def is_map(self):
        return isinstance(self.node, yaml.MappingNode)

    def is_list(self):
        return isinstance(self.node, yaml.SequenceNode)

    def scalar(self, what="one line of text"):
        if not isinstance(self.node, yaml.ScalarNode) or self.is_null():
            self.refuse("a list or map" if not self.is_null() else "nothing", what)
        return self.node.value

    def items(self, what="a list"):
        if not self.is_list():
            self.refuse(self.shown(), what)
        return [Value(child, self.file, f"{self.name}[{i}]")
                for i, child in enumerate(self.node.value)]

    def entries(self, what="a map"):
        """Of a map whose keys are free: (key, value) pairs in the file's order."""
        if not self.is_map():
            self.refuse(self.shown(), what)
        out = {}
        for key, child in self.node.value:
            text = Value(key, self.file, self.name).text()
            if text in out:
                Value(key, self.file, self.name).refuse(f'"{text}" twice', "each name once")
            out[text] = Value(child, self.file, f"{self.name}.{text}" if self.name else text)
        return out

    def keys(self, allowed, required=()):
        """Of a map whose keys are known; those that are absent are None."""
        found = self.entries()
        for key in found:
            if key not in allowed:
                near = difflib.get_close_matches(key, allowed, 1)
                hint = f'; did you mean "{near[0]}"?' if near else ""
                mark = next(k for k, _ in self.node.value if k.value == key)
                Value(mark, self.file, self.name or "the file").refuse(
                    f'the unknown key "{key}"', ", ".join(allowed) + hint)
        for key in required:
            if key not in found:
                self.refuse(f'no "{key}"', f"a file with it: {', '.join(allowed)}")
        return {key: found.get(key) for key in allowed}

    def choice(self, allowed):
        value = self.scalar(f"one of {', '.join(allowed)}")
        if value not in allowed:
            self.refuse(self.shown(), f"one of {', '.join(allowed)}")
        return value

    def number(self):
        try:
            return float(self.scalar("a number"))
        except ValueError:
            return self.refuse(self.shown(), "a number")

    def share(self):
        """"3 %" is 0.03."""
        match = PERCENT.match(self.scalar("a percentage such as 3 %"))
        try:
            value = float(match.group(1)) / 100 if match else 0
        except ValueError:
            value = 0
        if value <= 0:
            self.refuse(self.shown(), "a percentage above 0 such as 3 %")
        return value


def read(path, what="study"):
    """The file's top-level map."""
    try:
        text = path.read_text()
    except OSError as error:
        raise InputError(f"{path}: found {error.strerror.lower()}; allowed a {what} file"
                         + (", or a folder with a study.yaml" if what == "study" else "")
                         ) from error
    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        raise InputError(f"{path}:{mark.line + 1}:{mark.column + 1}: found no valid YAML "
                         f'({error.problem}); allowed YAML: "key: value" with indentation by '
                         "spaces") from error
    except yaml.YAMLError as error:
        raise InputError(f"{path}:1:1: found no valid YAML ({error}); allowed YAML") from error
    if node is None:
        raise InputError(f"{path}:1:1: found an empty file; allowed a {what}")
    return Value(node, path, "")
