#!/usr/bin/env python3
"""Writes results/suite.md and results/suite.svg: solvers ranked with problems as blocks, at several budgets.

  scripts/suite.py [BINARY] [--budgets 100:3,1000:1] [--long 10000:1] [--without DATA,MODEL] [--threads N] [--records DIR]

BUDGET:SEEDS each. Runs bench/studies/suite.toml once a budget, without the data and models of those labels, with the solvers
of its comment line "# where built: ..." that the program has, and at the long budget the part of it that its file names in a
comment line "# long: models ...; recordings ...". The records stay in
build/results/suite or DIR; rerun the command to resume. The page names the commit checked out, or what COMMIT in the
environment says the program was built from.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("binary", nargs="?", default=str(root / "build/release/hysteron"))
parser.add_argument("--budgets", default="100:3,1000:1")
parser.add_argument("--long", default="10000:1", help="empty: leave it out")
parser.add_argument("--without", default="", help="labels of [[data]] and models to leave out")
parser.add_argument("--threads", type=int, default=0)
parser.add_argument("--records", type=Path, default=root / "build/results/suite")
options = parser.parse_args()

source = (root / "bench/studies/suite.toml").read_text(encoding="utf-8")
optional = re.search(r"^# where built: (.*)$", source, flags=re.M)[1].split()
listed = json.loads(subprocess.run([options.binary, "list", "solvers", "--json"], check=True, capture_output=True, text=True).stdout)
known = {row["id"] for row in listed}
added = [name for name in optional if name in known]
missing = [name for name in optional if name not in known]
quoted = "".join(f', "{name}"' for name in added)
source = re.sub(r"^(solvers = \[[^\]]*)\]", lambda found: f"{found[1]}{quoted}]", source, flags=re.M)
out = options.records.absolute()
commit = os.environ.get("COMMIT") or subprocess.run(["git", "-C", str(root), "describe", "--always"], check=True, capture_output=True,
                                             text=True).stdout.strip()
out.mkdir(parents=True, exist_ok=True)
reference = "random-search"


def study_text(budget, seeds, part):
    text = re.sub(r"^budgets = .*$", f"budgets = [{budget}]", source, flags=re.M)
    text = re.sub(r"^seeds = .*$", f"seeds = {seeds}", text, flags=re.M)
    head, *data = text.split("[[data]]")
    for left_out in filter(None, options.without.split(",")):
        data = [block for block in data if f'label = "{left_out}"' not in block]
        head = re.sub(rf'^(models = .*?)(, )?"{left_out}"', r"\1", head, flags=re.M)
    text = "[[data]]".join([head, *data])
    if part:
        chosen = re.search(r"^# long: models (.*); recordings (.*)$", source, flags=re.M)
        models = ", ".join(f'"{name}"' for name in chosen[1].split())
        text = re.sub(r"^models = .*$", f"models = [{models}]", text, flags=re.M)
        keep = set(chosen[2].split())
        head, *data = text.split("[[data]]")
        blocks = []
        for block in data:
            names = re.findall(r'"([^"]+)"', re.search(r"^only = (.*)$", block, flags=re.M)[1])
            names = [name for name in names if name in keep]
            if names:
                listed = ", ".join(f'"{name}"' for name in names)
                blocks.append(re.sub(r"^only = .*$", f"only = [{listed}]", block, flags=re.M))
        text = "[[data]]".join([head, *blocks])
    return text


def analysis_of(name, budget, seeds, part):
    folder = out / name
    file = out / f"{name}.toml"
    file.write_text(study_text(budget, seeds, part), encoding="utf-8")
    threads = ["--threads", str(options.threads)] if options.threads else []
    # In shards, as a whole study ends with the identifiability of its best fits, which takes longer than the runs.
    benches = [["bench", str(file), "--out", str(folder), "--quiet", "--shard", f"{part_number}/2", *threads] for part_number in (1, 2)]
    for command in (*benches, ["report", str(folder)]):
        if code := subprocess.run([options.binary, *command], stdout=subprocess.DEVNULL).returncode:
            sys.exit(code)
    return json.loads((folder / "analysis.json").read_text(encoding="utf-8"))


studies = [(*map(int, word.split(":")), False) for word in options.budgets.split(",") if word]
if options.long:
    studies.append((*map(int, options.long.split(":")), True))
seeds_of = {budget: seeds for budget, seeds, _ in studies}
results = [(budget, part, analysis_of(str(budget), budget, seeds, part)) for budget, seeds, part in studies]


def label(analysis, solver):
    return analysis["solvers"][solver]["label"]


def medians(analysis):
    """(problem, solver) -> median NRMSE; a solver without a finite run has infinity."""
    return {(row["problem"], label(analysis, row["solver"])): math.inf if row["median"] is None else row["median"]
            for row in analysis["fixed_budget"]}


def ratio_text(value):
    if value is None:  # runs failed
        return "-"
    return f"{value:.2f}" if value < 100 else f"{value:.0f}"


def against_random(analysis):
    """solver -> (geometric mean of the median over that of random search, problems where it is worse by over 1 %)."""
    values = medians(analysis)
    problems = range(len(analysis["problems"]))
    table = {}
    for name in {solver for _, solver in values}:
        ratios = {p: values[p, name] / values[p, reference] for p in problems}
        finite = [r for r in ratios.values() if math.isfinite(r) and r > 0]
        table[name] = (math.exp(sum(math.log(r) for r in finite) / len(finite)),
                       [analysis["problems"][p]["label"] for p, r in ratios.items() if r > 1.01])
    return table


def to_target(analysis, wanted):
    """solver -> (share of the runs that reached the target, problems with a success, median over all problems of the
    ratio of its expected evaluations to the lowest of the problem, infinite where it has no success)."""
    rows = [row for row in analysis["fixed_target"] if row["target"] == wanted]
    least = {}
    for row in rows:
        if row["ert"] is not None:
            least[row["problem"]] = min(least.get(row["problem"], math.inf), row["ert"])
    table = {}
    for name in {label(analysis, row["solver"]) for row in rows}:
        own = [row for row in rows if label(analysis, row["solver"]) == name]
        ratios = sorted(math.inf if row["ert"] is None else row["ert"] / least[row["problem"]]
                        for row in own if row["problem"] in least)
        solved = sum(math.isfinite(ratio) for ratio in ratios)
        table[name] = (sum(row["successes"] for row in own) / sum(row["runs"] for row in own), solved, len(own),
                       ratios[len(ratios) // 2] if ratios else math.inf)
    return table


def over_the_first(analysis):
    """solver -> (mean cost ratio to the solver of the lowest mean rank, its 95 % interval, in practice)."""
    first = analysis["ranking"]["rows"][0]["solver"]
    table = {}
    for row in analysis["pairs"]:
        if first not in (row["a"], row["b"]):
            continue
        turned = row["a"] == first
        ratio, low, high = row["mean_ratio"], row["ratio_low"], row["ratio_high"]
        if turned:
            ratio, low, high = (value and 1 / value for value in (ratio, high, low))
        word = {"equal": "equal", "undecided": "undecided"}.get(
            row["practical"], "worse" if row["practical"] == ("a" if turned else "b") else "better")
        table[label(analysis, row["b"] if turned else row["a"])] = (
            f"{ratio_text(ratio)} [{ratio_text(low)}, {ratio_text(high)}]", word)
    return table


def headline(analysis):
    """What the places say of the first, and what the intervals say of those that share the first place."""
    rows = analysis["ranking"]["rows"]
    leader, *others = [label(analysis, row["solver"]) for row in rows if row["place"] == 1]
    if not others:
        return f"By the ranks {leader} is ahead of all others."
    over = over_the_first(analysis)
    told = [(word, [name for name in others if over[name][1] == word]) for word in ("better", "equal", "undecided", "worse")]
    said = "; ".join(f"{word} {', '.join(names)}" for word, names in told if names)
    return f"The ranks do not tell the {len(others) + 1} at the first place apart. By the intervals over {leader}, listed first: {said}."


def ranks_apart(analysis, member):
    """solver -> mean rank among the problems of a kind, which has so many of them."""
    ranking = analysis.get(member)
    if ranking is None:
        return 0, {}
    return ranking["problems"], {label(analysis, row["solver"]): f"{row['mean_rank']:.1f}" for row in ranking["rows"]}


palette = ["#1b6ca8", "#c0392b", "#1e8449", "#8e44ad", "#b9770e", "#00a3c4", "#2c3e50", "#d35400", "#7f8c8d", "#a93226"]
width, height, margin = 340, 250, 46


def chart(x0, y0, title, xs, curves, x_label, shown, x_log=True):
    def at(x):
        low, high = math.log10(xs[0]), math.log10(xs[-1])
        return x0 + margin + (math.log10(x) - low) / (high - low) * (width - margin - 20)

    def up(y):
        return y0 + height - margin - y * (height - margin - 26)

    parts = [f'<text x="{x0 + margin}" y="{y0 + 16}" font-weight="bold">{title}</text>']
    for share in (0, 0.25, 0.5, 0.75, 1):
        parts.append(f'<line x1="{x0 + margin}" x2="{x0 + width - 20}" y1="{up(share):.1f}" y2="{up(share):.1f}" stroke="#ddd"/>'
                     f'<text x="{x0 + margin - 4}" y="{up(share) + 4:.1f}" text-anchor="end">{share:g}</text>')
    tick = 10 ** math.ceil(math.log10(xs[0]) - 1e-9)
    while tick <= xs[-1] * 1.0001:
        parts.append(f'<text x="{at(tick):.1f}" y="{y0 + height - margin + 15}" text-anchor="middle">{tick:g}</text>')
        tick *= 10
    parts.append(f'<text x="{x0 + margin}" y="{y0 + height - margin + 30}">{x_label}</text>')
    for name, values in curves.items():
        bold = name in shown
        color = palette[shown.index(name) % len(palette)] if bold else "#ccc"
        points = " ".join(f"{at(x):.1f},{up(y):.1f}" for x, y in zip(xs, values))
        line = (f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="{1.8 if bold else 0.8}"'
                f'{" stroke-dasharray=" + chr(34) + "5 3" + chr(34) if name == reference else ""}><title>{name}</title></polyline>')
        parts.append(line) if bold else parts.insert(1, line)
    return parts


def picture():
    columns = len(results)
    # The leaders of every budget and random search; the others in grey.
    shown = []
    for _, _, analysis in results:
        shown += [label(analysis, row["solver"]) for row in analysis["ranking"]["rows"][:4]]
    shown = list(dict.fromkeys([*shown, reference, "pso", "ga"]))[:10]
    total_width = columns * width
    total_height = 3 * height + 24 * math.ceil(len(shown) / 4) + 16
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total_width} {total_height}" width="{total_width}" '
             f'height="{total_height}" font-family="sans-serif" font-size="11"><rect width="100%" height="100%" fill="white"/>']
    for column, (budget, _, analysis) in enumerate(results):
        names = [label(analysis, s) for s in range(len(analysis["solvers"]))]
        rows = [("Targets reached (ECDF)", "evaluations", analysis["ecdf"]["evaluations"], analysis["ecdf"]["share"]),
                ("Performance profile", "expected evaluations over the least", analysis["profiles"]["ratios"],
                 analysis["profiles"]["performance"]),
                ("Data profile, 1 % above the best known", "evaluations / (dimension + 1)",
                 analysis["profiles"]["simplex_gradients"], analysis["profiles"]["data"])]
        for row, (title, x_label, xs, curves) in enumerate(rows):
            parts += chart(column * width, row * height, f"{title}, {budget}", xs, dict(zip(names, curves)), x_label, shown)
    for k, name in enumerate(shown):
        x, y = 20 + (k % 4) * (total_width - 40) / 4, 3 * height + 16 + 24 * (k // 4)
        parts.append(f'<line x1="{x}" x2="{x + 26}" y1="{y}" y2="{y}" stroke="{palette[k % len(palette)]}" stroke-width="2"'
                     f'{" stroke-dasharray=" + chr(34) + "5 3" + chr(34) if name == reference else ""}/>'
                     f'<text x="{x + 32}" y="{y + 4}">{name}</text>')
    return "\n".join([*parts, "</svg>"]) + "\n"


# What changes the page; the program and its threads do not.
command = "scripts/suite.py" + "".join(
    f" --{name} {getattr(options, name) or chr(39) * 2}" for name in ("budgets", "long", "without")
    if getattr(options, name) != parser.get_default(name))
lines = ["# Solvers on a suite of problems", "",
         f"Made by `{command}` from `bench/studies/suite.toml`: {len(results[0][2]['problems'])} problems "
         f"({len({p['model'] for p in results[0][2]['problems']})} models on {len({p['data'] for p in results[0][2]['problems']})} "
         f"recordings, of which none chose a default), defaults as shipped. Program: commit {commit}. Every budget is a study of its own, as several solvers "
         "set their population by the budget." +
         (f" Left out of the study for their length: {options.without.replace(',', ', ')}." if options.without else "") +
         (f" The rows {', '.join(added)} are solvers of libraries that a build may be without (docs/dependencies.md)." if added else "") +
         (f" Not in this build and left out: {', '.join(missing)}." if missing else "") +
         ("" if not options.long else
          f" {results[-1][0]} evaluations: the part of the suite that is cheap enough, {len(results[-1][2]['problems'])} problems."), "",
         "A problem is a block: each solver counts once a problem, with its median over the seeds. Places are those of "
         "Friedman's test with Nemenyi's critical difference at 5 %: one more than the number of solvers shown to be better. "
         "Over the first: geometric mean over the problems of the NRMSE over that of the solver of the lowest mean rank, with "
         "the 95 % interval of a bootstrap that draws problems and then seeds within them; in practice: worse where the "
         f"interval lies above {1 + results[0][2]['equivalence']:g}, equal where it lies within that factor either way, else undecided. "
         "Inside, on the box: mean ranks where the best known point lies inside the box, and where one of its parameters at "
         "least sits on an end of its range. Over random search: geometric mean of the median NRMSE over that of random "
         "search at the same seeds. Expected evaluations: over the least of any solver, median over all problems; - where "
         "half of the problems or more are not solved.", ""]
for budget, part, analysis in results:
    ranking = analysis["ranking"]
    random = against_random(analysis)
    lines += [f"## {budget} evaluations", "",
              f"{headline(analysis)} {ranking['blocks']} blocks, {seeds_of[budget]} {'seed' if seeds_of[budget] == 1 else 'seeds'}, critical difference {ranking['critical_difference']:.2f} ranks.", ""]
    first_target = analysis["fixed_target"][0]["target"]
    reached = to_target(analysis, first_target)
    over = over_the_first(analysis)
    inside_of, inside = ranks_apart(analysis, "ranking_inside")
    on_box_of, on_box = ranks_apart(analysis, "ranking_on_box")
    lines += [f"| place | solver | mean rank | inside ({inside_of}) | on the box ({on_box_of}) | over the first [95 %] | in practice | "
              "over random search | worse than it on | runs within 1 % of the best known | problems of these | expected evaluations |",
              "|--:|---|--:|--:|--:|--:|---|--:|--:|--:|--:|--:|"]
    for row in ranking["rows"]:
        name = label(analysis, row["solver"])
        share, solved, of, ert = reached[name]
        ratio, word = over.get(name, ("1", "-"))
        lines.append(f"| {row['place']} | {name} | {row['mean_rank']:.2f} | {inside.get(name, '-')} | {on_box.get(name, '-')} | {ratio} | "
                     f"{word} | {ratio_text(random[name][0])} | {len(random[name][1])} | "
                     f"{100 * share:.0f} % | {solved} of {of} | {'-' if math.isinf(ert) else ratio_text(ert)} |")
    worse = {name: where for name, (_, where) in random.items() if where}
    lines.append("")
    if worse:
        lines.append("Worse than random search by more than 1 % in the median:")
        lines.append("")
        for name in sorted(worse, key=lambda n: (-len(worse[n]), n)):
            where = worse[name]
            text = "; ".join(where[:6]) + (f"; and {len(where) - 6} more" if len(where) > 6 else "")
            lines.append(f"- {name}, {len(where)} of {len(analysis['problems'])}: {text}")
    else:
        lines.append("No solver is worse than random search on any problem.")
    lines.append("")
alone = [str(budget) for budget, seeds in seeds_of.items() if seeds == 1]
lines += ["Likely reasons, not measured, why some are worse than random search: a population has made two to ten generations by 100 evaluations, each bound "
          "to where its first points fell, while random search still looks everywhere; a local method (pattern search, the "
          "simplex, BOBYQA) spends such a budget around one random start, and BOBYQA and pattern search also end in a local "
          "minimum later." + (f" At {', '.join(alone)} evaluations, with one seed a problem, single cases are chance too." if alone else ""), ""]
lines += ["## Distributions and profiles", "",
          "![Targets reached, performance profile and data profile at each budget](suite.svg)", "",
          "Targets reached: share of (problem, seed, target) over evaluations, 41 targets from 0.1 % to 1000 % above the best "
          "known cost. Performance profile: share of (problem, target) whose expected run time is within a factor of the least. "
          "Data profile: share of (problem, seed) solved to 1 % above the best known cost. The best known cost is the best of all "
          "runs of that budget. In grey: the other solvers.", "",
          "## Problems", "",
          "| problem | dimension | " + " | ".join(f"best at {budget}" for budget, _, _ in results) +
          " | by, at the largest | on the box |",
          "|---|--:|" + "--:|" * len(results) + "---|---|"]
for problem in results[0][2]["problems"]:
    cells = []
    solver = ""
    on_box = []
    for _, _, analysis in results:
        own = [p for p in analysis["problems"] if p["label"] == problem["label"]]
        best = own[0]["best"] if own else None
        cells.append(f"{best['nrmse']:.4f}" if best else "-")
        solver = best["solver"] if best else solver
        on_box = best["on_box"] if best else on_box
    lines.append(f"| {problem['label']} | {problem['dimension']} | " + " | ".join(cells) + f" | {solver} | {', '.join(on_box) or '-'} |")
lines += ["", "What such a table says is of these problems: damper laws in the program's coordinates, on sines. A solver that uses "
          "derivatives is charged 1 + dimension evaluations a point, as finite differences would be.", ""]
(root / "results/suite.md").write_text("\n".join(lines), encoding="utf-8")
(root / "results/suite.svg").write_text(picture(), encoding="utf-8")
