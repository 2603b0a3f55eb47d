"""An objective of one's own for `hysteron minimise`: Rosenbrock's valley. docs/own-solver.md has the protocol."""
import json
import sys

sys.stdin.readline()  # names and box of the parameters
for line in sys.stdin:
    points = json.loads(line)["evaluate"]
    costs = [(1 - x) ** 2 + 100 * (y - x * x) ** 2 for x, y in points]
    print(json.dumps({"costs": costs}), flush=True)
