# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas of a study file: numbers, names, + - * / **, parts of lists, and the
functions below, on numbers and numpy arrays."""
import ast
import operator

import numpy as np

OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
             ast.Div: operator.truediv, ast.Pow: operator.pow, ast.USub: operator.neg,
             ast.UAdd: operator.pos}
FUNCTIONS = {name: getattr(np, name)
             for name in ("exp", "log", "sqrt", "sin", "cos", "tan", "tanh", "abs")}
CONSTANTS = {"pi": np.pi}


class Formula:
    """Checked when it is made (ValueError says what is wrong), evaluated as often as needed."""

    def __init__(self, text):
        self.text = text
        try:
            self.tree = ast.parse(text, mode="eval").body
        except SyntaxError as error:
            raise ValueError(f'the formula "{text}", which cannot be read') from error
        self.names = set()
        self._look(self.tree)

    def _look(self, node):
        if isinstance(node, ast.Name):
            if node.id not in CONSTANTS:
                self.names.add(node.id)
        elif isinstance(node, ast.Subscript):
            self._look(node.value)
            self._look(node.slice)
        elif isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            self._look(node.left)
            self._look(node.right)
        elif isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
            self._look(node.operand)
        elif isinstance(node, ast.Call) and getattr(node.func, "id", "") in FUNCTIONS:
            for argument in node.args:
                self._look(argument)
        elif not (isinstance(node, ast.Constant) and isinstance(node.value, (int, float))):
            raise ValueError(f'"{ast.unparse(node)}" in the formula "{self.text}"')

    def __call__(self, **values):
        return self._value(self.tree, {**CONSTANTS, **values})

    def _value(self, node, values):
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.Name):
            return values[node.id]
        if isinstance(node, ast.Subscript):
            return self._value(node.value, values)[int(self._value(node.slice, values))]
        if isinstance(node, ast.Call):
            return FUNCTIONS[node.func.id](*[self._value(a, values) for a in node.args])
        if isinstance(node, ast.UnaryOp):
            return OPERATORS[type(node.op)](self._value(node.operand, values))
        return OPERATORS[type(node.op)](self._value(node.left, values),
                                        self._value(node.right, values))


def formula(value, names, text=None):
    """Checked: of these names only. text: where it is but a part of the value."""
    try:
        made = Formula(text or value.scalar("a formula"))
    except ValueError as error:
        value.refuse(str(error), "numbers, + - * / **, exp, log, sqrt, sin, cos, tan, tanh, "
                     f"abs, pi, {', '.join(names)}")
    unknown = sorted(made.names - set(names))
    if unknown:
        value.refuse(f'the name "{unknown[0]}"', f"one of {', '.join(names)}")
    return made
