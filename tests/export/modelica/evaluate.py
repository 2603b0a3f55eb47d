"""Evaluates block Damper of an exported package.mo, without a Modelica compiler: parses it by the grammar of Modelica 3.6
as far as it is used, checks that every name is declared and that there are as many equations as unknowns, integrates it
on the motion of the package's test vector, and prints the largest difference to the force there, as a share of the
largest force.

    python3 evaluate.py package.mo
"""

import math
import re
import sys

try:
    import numpy
    import scipy.integrate
except ImportError:
    print("scipy is not installed")
    sys.exit(77)

TOKEN = re.compile(
    r"\s+|//[^\n]*|(?P<string>\"[^\"]*\")|(?P<number>\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign>:=|<=|>=|<>|==|[-+*/^(){}\[\],;:=<>.])")
BUILT_IN = {"abs": "abs", "min": "min", "max": "max", "sqrt": "math.sqrt", "exp": "math.exp", "log": "math.log",
            "tanh": "math.tanh"}


def tokens_of(text):
    at, result = 0, []
    while at < len(text):
        match = TOKEN.match(text, at)
        assert match, f"no token of Modelica: {text[at:at + 40]!r}"
        if match.lastgroup:
            result.append((match.lastgroup, match.group(match.lastgroup)))
        at = match.end()
    return result


class Parser:
    """Expressions to Python's, with the names that they use."""

    first_of = {}  # functions of several results, of which an expression takes the first

    def __init__(self, text):
        self.tokens = tokens_of(text) + [("end", "")]
        self.at = 0
        self.names = set()
        self.calls = set()

    def peek(self):
        return self.tokens[self.at][1]

    def take(self, expected=None):
        kind, text = self.tokens[self.at]
        assert expected is None or text == expected, f"{text!r} where {expected!r} is expected: {self.tokens[self.at - 5:self.at + 5]}"
        self.at += 1
        return kind, text

    def expression(self):
        if self.peek() != "if":
            return self.disjunction()
        self.take("if")
        condition = self.expression()
        self.take("then")
        yes = self.expression()
        self.take("else")
        return f"({yes} if {condition} else {self.expression()})"

    def chain(self, sub, words):
        text = sub()
        while self.peek() in words:
            text += f" {self.take()[1]} {sub()}"
        return text

    def disjunction(self):
        return self.chain(self.conjunction, ("or",))

    def conjunction(self):
        return self.chain(self.relation, ("and",))

    def relation(self):
        left = self.sum()
        if self.peek() in ("<", "<=", ">", ">="):
            left += f" {self.take()[1]} {self.sum()}"
        return left

    def sum(self):  # a sign may only begin it
        sign = self.take()[1] if self.peek() in ("+", "-") else ""
        return sign + self.chain(self.product, ("+", "-"))

    def product(self):
        return self.chain(self.primary, ("*", "/"))

    def primary(self):
        kind, text = self.take()
        if kind == "number":
            return text
        if text == "(":
            inside = self.expression()
            self.take(")")
            return f"({inside})"
        assert kind == "name", f"{text!r} begins no expression: {self.tokens[self.at - 6:self.at + 4]}"
        if self.peek() != "(":
            self.names.add(text)
            return text
        self.take("(")
        arguments = [self.expression()]
        while self.peek() == ",":
            self.take(",")
            arguments.append(self.expression())
        self.take(")")
        if text in ("noEvent",):
            return f"({arguments[0]})"
        if text == "der":
            name = f"der_{arguments[0]}"
            self.names.remove(arguments[0])
            self.names.add(name)
            return name
        if text == "pre":
            return arguments[0]
        if text == "delay":
            return f"delayed_{arguments[0]}(time - {arguments[1]})"
        self.calls.add(text)
        return f"{BUILT_IN.get(text, text)}({', '.join(arguments)}){self.first_of.get(text, '')}"


def expression_of(text):
    parser = Parser(text)
    result = parser.expression()
    assert parser.peek() == "", f"more than an expression: {text}"
    return result, parser


def statements_of(text):
    text = re.sub(r"//[^\n]*", "", re.sub(r'"[^"]*"', "", text))
    return [" ".join(one.split()) for one in text.split(";") if one.strip()]


def functions_of(package):
    """Python's text of every function."""
    result = ""
    for name, body in re.findall(r"^  function (\w+) \"[^\"]*\"\n(.*?)^  end \1;", package, re.S | re.M):
        declared, algorithm = body.split("algorithm")
        declarations = [one.replace("protected", "").split() for one in statements_of(declared)]
        inputs = [words[2] for words in declarations if words[0] == "input"]
        outputs = [words[2] for words in declarations if words[0] == "output"]
        known = set(inputs) | {words[-1] for words in declarations}
        result += f"def {name}({', '.join(inputs)}):\n"
        for one in statements_of(algorithm):
            left, right = one.split(":=")
            text, parser = expression_of(right)
            assert parser.names <= known and left.strip() in known, f"{name}: {parser.names - known}"
            result += f"    {left.strip()} = {text}\n"
        result += f"    return {', '.join(outputs)}\n"
        if len(outputs) > 1:
            Parser.first_of[name] = "[0]"
    return result


def scalar_root(residual, start):
    """Of a function that rises; steps by Illinois, which take the sign of a root within a root as it comes."""
    g = residual(start)
    if abs(g) <= 1e-14 * abs(start):
        return start
    ends = {g < 0.0: (start, g)}
    step = max(abs(g), 1e-12)
    while len(ends) < 2:
        u = start - math.copysign(step, g)
        ends.setdefault((value := residual(u)) < 0.0, (u, value))
        step *= 2.0
    (low, below), (high, above) = ends[True], ends[False]
    for k in range(200):
        if high - low <= 4e-16 * max(abs(low), abs(high)):
            break
        u = low - below * (high - low) / (above - below) if k % 4 != 3 else 0.5 * (low + high)
        u = u if low < u < high else 0.5 * (low + high)
        value = residual(u)
        if abs(value) <= 1e-14 * abs(u):
            return u
        if value < 0.0:
            low, below, above = u, value, 0.5 * above
        else:
            high, above, below = u, value, 0.5 * below
    return u


class Block:
    def __init__(self, package):
        self.functions = functions_of(package)
        body = re.search(r"^  block Damper \"[^\"]*\"\n(.*?)^  end Damper;", package, re.S | re.M).group(1)
        head, rest = re.split(r"^  equation\n", body, maxsplit=1, flags=re.M)
        initial = re.search(r"^  initial equation\n(.*)", head, re.S | re.M)
        head = head[:initial.start()] if initial else head
        when = re.search(r"when sample\((.*?)\) then\n(.*?)end when;", rest, re.S)
        rest = rest[:when.start()] if when else rest
        self.inputs, self.parameters, self.states, self.discrete, variables = [], {}, [], [], set()
        for one in statements_of(head.replace("  protected\n", "")):
            words = re.match(r"(input |output |parameter |discrete )?Real (\w+)(\(.*?\))?(?: = (.*))?$", one)
            assert words, f"no declaration: {one}"
            kind, name, attributes, value = words.groups()
            if kind == "input ":
                self.inputs.append(name)
            elif kind == "parameter ":
                self.parameters[name] = value
            elif kind == "discrete ":
                self.discrete.append(name)
            else:
                variables.add(name)
                if attributes and "start = 0, fixed = true" in attributes:
                    self.states.append(name)
        known = {"time", *self.inputs, *self.parameters, *self.states, *self.discrete, *variables,
                 *(f"der_{name}" for name in self.states)}
        self.equations = {}
        for one in statements_of(rest):
            left, right = one.split(" = ", 1)
            left, _ = expression_of(left)
            text, parser = expression_of(right)
            assert parser.names <= known, f"undeclared: {parser.names - known}"
            assert left in known and left not in self.equations, f"{left} is not to be solved for"
            self.equations[left] = (text, parser.names)
        unknowns = (variables - set(self.states)) | {f"der_{name}" for name in self.states}
        assert set(self.equations) == unknowns, f"unknowns without equation: {unknowns - set(self.equations)}"
        names = {}
        exec(f"import math\n{self.functions}", names)
        for name, value in self.parameters.items():
            text, parser = expression_of(value)
            assert parser.names <= set(self.parameters)
            names[name] = eval(text, names)
        self.names = names
        self.start = self.tuples(statements_of(initial.group(1)) if initial else [], known)
        self.update = self.tuples(statements_of(when.group(2)) if when else [], known)
        self.period = eval(expression_of(when.group(1).split(",")[1])[0], names) if when else math.inf

    def tuples(self, equations, known):
        result = []
        for one in equations:
            left, right = one.split(" = ", 1)
            text, parser = expression_of(right)
            text = text.removesuffix("[0]")  # all results are taken
            assert parser.names <= known, f"undeclared: {parser.names - known}"
            assert set(re.findall(r"\w+", left)) <= set(self.discrete), left
            result.append((left, text, parser.names))
        return result

    def lines_for(self, wanted, known):
        """Python's lines that work out what is wanted, with loops through derivatives solved for."""
        lines, done = [], set(known)

        def visit(name, path, into, ready):
            if name in ready or name not in self.equations:
                return None
            if name in path:
                loop = path[path.index(name):]
                return [one for one in loop if one.startswith("der_")]
            for other in sorted(self.equations[name][1]):
                torn = visit(other, path + [name], into, ready)
                if torn:
                    return torn
            into.append(f"{name} = {self.equations[name][0]}")
            ready.add(name)
            return None

        def settle(names, into, ready):
            for name in names:
                attempt, known_now = [], set(ready)
                torn = visit(name, [], attempt, known_now)
                if torn is None:
                    into += attempt
                    ready |= known_now
                    continue
                # The loop's derivative is found as the root of its own equation.
                variable = torn[0]
                inner, within = [], set(ready) | {variable}
                settle(sorted(self.equations[variable][1]), inner, within)
                into.append(f"def residual_{variable}({variable}):")
                into += ["    " + line for line in inner]
                into.append(f"    return {variable} - ({self.equations[variable][0]})")
                into.append(f"{variable} = guess['{variable}'] = scalar_root(residual_{variable}, guess.get('{variable}', 0.0))")
                ready.add(variable)
                settle([name], into, ready)

        settle(wanted, lines, done)
        return lines

    def compile(self, motion):
        """rhs(t, y) and force(t, y) with the discrete variables in a dictionary."""
        known = {"time", *self.inputs, *self.parameters, *self.states, *self.discrete}
        names = dict(self.names, scalar_root=scalar_root, guess={}, motion=motion, discrete={})
        for name in self.inputs:
            names[f"delayed_{name}"] = lambda t, name=name: motion(t)[name]
        head = [f"{name} = y[{k}]" for k, name in enumerate(self.states)]
        head += ["seen = motion(time)", *(f"{name} = seen['{name}']" for name in self.inputs)]
        head += [f"{name} = discrete.get('{name}', 0.0)" for name in self.discrete]

        def function(name, wanted, result):
            body = head + self.lines_for(wanted, known) + [f"return {result}"]
            exec(f"def {name}(time, y):\n" + "".join(f"    {line}\n" for line in body), names)
            return names[name]

        rates = [f"der_{name}" for name in self.states]
        self.discrete_values = names["discrete"]
        rhs = function("rhs", rates, f"[{', '.join(rates)}]")
        force = function("force_at", ["force"], "force")

        def event(name, tuples):
            if not tuples:
                return lambda time, y: None
            used = sorted(set().union(*(names_used for _, _, names_used in tuples)))
            body = [line for line in head] + self.lines_for(used, known)
            body += [f"new_{k} = {text}" for k, (_, text, _) in enumerate(tuples)]
            body += [f"{left} = new_{k}" for k, (left, _, _) in enumerate(tuples)]
            body += [f"discrete['{one}'] = {one}" for one in self.discrete]
            exec(f"def {name}(time, y):\n" + "".join(f"    {line}\n" for line in body), names)
            return names[name]

        return rhs, force, event("begin", self.start), event("update", self.update)


def constants_of(package):
    test = re.search(r"^  model Test .*?^  end Test;", package, re.S | re.M).group(0)
    arrays = {name: numpy.array([float(one) for one in values.split(",")])
              for name, values in re.findall(r"constant Real (\w+)\[:\] = \{(.*?)\};", test, re.S)}
    return arrays, int(re.search(r"constant Integer first = (\d+)", test).group(1))


def motion_of(table):
    t = table["t"]

    def cubic(u, h, y0, y1, slope0, slope1):
        c2 = 3 * (y1 - y0) - h * (2 * slope0 + slope1)
        c3 = h * (slope0 + slope1) - 2 * (y1 - y0)
        return ((c3 * u + c2) * u + h * slope0) * u + y0, ((3 * c3 * u + 2 * c2) * u + h * slope0) / h

    # One interval at a time: a point between two belongs to the one that is integrated over.
    at = {"n": 0}

    def motion(time):
        n = at["n"]
        if not t[n] - 1e-12 <= time <= t[n + 1] + 1e-12:  # of a delay
            n = int(numpy.clip(numpy.searchsorted(t, time, side="right") - 1, 0, len(t) - 2))
            time = max(time, t[0])
        h = t[n + 1] - t[n]
        u = (time - t[n]) / h
        seen = {"displacement": cubic(u, h, *table["x"][n:n + 2], *table["v"][n:n + 2])[0],
                "velocity": cubic(u, h, *table["v"][n:n + 2], *table["slope"][n:n + 2])[0]}
        if "a" in table:
            seen["acceleration"], seen["jerk"] = cubic(u, h, *table["a"][n:n + 2], *table["j"][n:n + 2])
        if "i" in table:
            seen["drive"] = table["i"][n] + (table["i"][n + 1] - table["i"][n]) * u
        return seen

    return motion, at


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        package = file.read()
    block = Block(package)
    table, first = constants_of(package)
    motion, at = motion_of(table)
    rhs, force, begin, update = block.compile(motion)
    t = table["t"]
    y = numpy.zeros(len(block.states))
    largest = numpy.full(len(y), 1e-9)
    begin(t[0], y)
    worst = abs(force(t[0], y) - table["expected"][0]) if first == 1 else 0.0
    for n in range(len(t) - 1):
        at["n"] = n
        if len(y):
            done = scipy.integrate.solve_ivp(rhs, (t[n], t[n + 1]), y, method="LSODA", rtol=1e-9, atol=1e-10 * largest)
            assert done.success, done.message
            y = done.y[:, -1]
            largest = numpy.maximum(largest, abs(y))
        update(t[n + 1], y)
        if n + 2 >= first:
            worst = max(worst, abs(force(t[n + 1], y) - table["expected"][n + 1]))
    print(worst / max(abs(table["expected"])))


if __name__ == "__main__":
    main()
