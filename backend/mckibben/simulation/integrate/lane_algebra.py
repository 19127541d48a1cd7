"""The elimination of a structure as straight-line code on rows of lanes."""

from __future__ import annotations

from mckibben.simulation.integrate.coefficients import GAMMA
from mckibben.simulation.integrate.elimination import Plan
from mckibben.simulation.integrate.machine_code import number


def algebra_texts(plan: Plan, lanes: int) -> list[str]:
    """LLVM's text of two functions for the systems (1/(gamma h) - J) x = b.

    ``factorise(matrix, entries of J, h)`` writes the factors at the positions of the plan, and at the plan's
    last position the least magnitude of the pivots; ``solve(vector, matrix, -)`` solves in place.
    """
    return [*_Code(lanes).factorise(plan), _Code(lanes).solve(plan)]


class _Code:
    def __init__(self, lanes: int) -> None:
        self.lanes, self.real = lanes, f"<{lanes} x double>"
        self.lines: list[str] = []
        self.declared: set[str] = set()

    def new(self, text: str) -> str:
        name = f"%t{len(self.lines)}"
        self.lines.append(f"{name} = {text}")
        return name

    def place(self, array: str, index: int) -> str:
        return self.new(f"getelementptr {self.real}, ptr %{array}, i64 {index}")

    def load(self, array: str, index: int) -> str:
        return self.new(f"load {self.real}, ptr {self.place(array, index)}")

    def store(self, array: str, index: int, value: str) -> None:
        self.lines.append(f"store {self.real} {value}, ptr {self.place(array, index)}")

    def of(self, operation: str, a: str, b: str) -> str:
        return self.new(f"{operation} contract {self.real} {a}, {b}")

    def number(self, value: float) -> str:
        return f"splat (double {number(value)})"

    def text(self, name: str) -> str:
        body = "\n".join(self.lines)
        return f"define void @{name}(ptr noalias %out, ptr noalias %in, ptr %data) {{\n{body}\nret void\n}}"

    def factorise(self, plan: Plan) -> list[str]:
        absolute, truth = f"llvm.fabs.v{self.lanes}f64", f"<{self.lanes} x i1>"
        shift = self.of("fdiv", self.number(1.0 / GAMMA), self.load("data", 0))
        matrix = {
            place: self.new(f"fneg {self.real} {self.load('in', entry)}")
            for entry, place in enumerate(plan.places.tolist())
        }
        for place in plan.diagonal.tolist():
            matrix[place] = self.of("fadd", matrix[place], shift) if place in matrix else shift
        least = self.number(float("inf"))
        for pivot, low, low_end, first, stop in plan.pivots.tolist():
            size = self.new(f"call {self.real} @{absolute}({self.real} {matrix[pivot]})")
            # A NaN is taken: it compares false later.
            keeps = self.new(f"fcmp oge {self.real} {size}, {least}")
            least = self.new(f"select {truth} {keeps}, {self.real} {least}, {self.real} {size}")
            matrix[pivot] = self.of("fdiv", self.number(1.0), matrix[pivot])
            for place in plan.lower[low:low_end].tolist():
                matrix[place] = self.of("fmul", matrix[place], matrix[pivot])
            for target, below, right in plan.updates[first:stop].tolist():
                product = self.of("fmul", matrix[below], matrix[right])
                if target in matrix:
                    matrix[target] = self.of("fsub", matrix[target], product)
                else:
                    matrix[target] = self.new(f"fneg {self.real} {product}")
        for place, value in matrix.items():
            self.store("out", place, value)
        self.store("out", plan.size - 1, least)
        self.declared.add(f"declare {self.real} @{absolute}({self.real})")
        return [self.text("factorise"), *sorted(self.declared)]

    def solve(self, plan: Plan) -> str:
        vector: dict[int, str] = {}

        def part(state: int) -> str:
            if state not in vector:
                vector[state] = self.load("out", state)
            return vector[state]

        for state, first, stop, factor in plan.rows.tolist():
            total = part(state)
            for place, other in plan.terms[first:stop].tolist():
                total = self.of("fsub", total, self.of("fmul", self.load("in", place), part(other)))
            if factor != plan.size - 1:
                total = self.of("fmul", total, self.load("in", factor))
            vector[state] = total
        for state, value in vector.items():
            self.store("out", state, value)
        return self.text("solve")
