"""Diagnoses against the answers of campaigns by another generator: rates with bounds, and the page that keeps them."""
from math import comb

# Of the stated probability, as in the scores of a challenge.
edges = (0.0, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0)

blank_page = """# Campaigns by another hand

| what |
|---|
"""


def tail(hits, trials, p):
    """Probability of so many hits or more."""
    return sum(comb(trials, k) * p**k * (1 - p) ** (trials - k) for k in range(hits, trials + 1))


def clopper_pearson(hits, trials, confidence=0.95):
    """Two-sided exact bounds by bisection on the binomial tails; [0, 1] without trials.

    Clopper, Pearson, Biometrika 26 (1934) 404-413, doi 10.1093/biomet/26.4.404.
    """
    if trials == 0:
        return 0.0, 1.0
    side = (1 - confidence) / 2

    def where(reached):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if reached(middle) else (middle, high)
        return low

    lower = 0.0 if hits == 0 else where(lambda p: tail(hits, trials, p) >= side)
    upper = 1.0 if hits == trials else where(lambda p: 1 - tail(hits + 1, trials, p) <= side)
    return lower, upper


def rate(hits, trials):
    low, high = clopper_pearson(hits, trials)
    return {"hits": hits, "trials": trials, "low95": low, "high95": high}


def kind_of(answer):
    """What a campaign asks, from what is in it."""
    effects, foreign = len(answer["effects"]), len(answer["foreign"])
    if answer["level"] == "buried":
        return "buried"
    if effects > 2 or (effects > 0 and foreign > 0):
        return "compound"
    if effects > 0:
        return "plain" if effects == 1 else "pairs"
    return "foreign" if foreign > 0 else "none"


def claims_of(answer, diagnosis):
    """Statements of a diagnosis. Names are what `effects` holds, with a grade or, in schema 1, under missing-physics."""
    causes = set(answer["effects"])
    asserted = diagnosis["verdict"] == "missing-physics"
    result = []
    for key in ("effects", "suggestions"):
        for effect in diagnosis.get(key, []):
            members = {effect["id"], *effect.get("indistinguishable_from", [])}
            suggested = key == "suggestions" or effect.get("grade") == "suggested"
            if len(members) > 1 and any(row["set"] == sorted(members) for row in result):
                continue  # a set has a row for each of its members; it is stated once
            result.append({"id": effect["id"], "set": sorted(members), "right": bool(members & causes),
                           "suggested": suggested, "confidence": effect.get("confidence"),
                           "name": not suggested and ("grade" in effect or asserted)})
    return result


def outcome_of(case, answer, diagnosis):
    claims = claims_of(answer, diagnosis)
    causes = set(answer["effects"])
    listed = [claim for claim in claims if not claim["suggested"]]
    alone = {claim["id"] for claim in listed if claim["name"] and len(claim["set"]) == 1}
    in_sets = {cause for claim in listed if claim["id"] not in alone for cause in causes & set(claim["set"])}
    return {"campaign": case, "kind": kind_of(answer), "truth": answer["effects"] + answer["foreign"],
            "verdict": diagnosis["verdict"], "claims": claims,
            "named": sorted(alone & causes), "in_a_set": sorted(in_sets - alone),
            "all_named": bool(causes) and causes <= alone,
            "wrong": [claim for claim in listed if claim["name"] and not claim["right"]],
            "any_name": any(claim["name"] for claim in listed)}


def scored(answers, diagnoses, ended):
    """Counts and rates. `diagnoses` by campaign, those that were finished; `ended`: how every one that was tried did."""
    rows = [outcome_of(case, answers[case], diagnoses[case]) for case in answers if case in diagnoses]

    def of(kind, passes):
        chosen = [row for row in rows if row["kind"] == kind]
        return rate(sum(1 for row in chosen if passes(row)), len(chosen))

    claims = [claim for row in rows for claim in row["claims"]]
    names = [claim for claim in claims if claim["name"]]
    rates = {
        "plain: right": of("plain", lambda r: r["all_named"] and not r["wrong"]),
        "plain: right, with a second name that is not in the truth": of("plain", lambda r: r["all_named"] and r["wrong"]),
        "plain: in a set": of("plain", lambda r: r["in_a_set"] and not r["wrong"]),
        "plain: a name or set without a cause": of("plain", lambda r: r["wrong"]),
        "at or below the noise: right": of("buried", lambda r: r["all_named"] and not r["wrong"]),
        "at or below the noise: in a set": of("buried", lambda r: r["in_a_set"] and not r["wrong"]),
        "at or below the noise: a name or set without a cause": of("buried", lambda r: r["wrong"]),
        "pairs: both": of("pairs", lambda r: r["all_named"] and not r["wrong"]),
        "pairs: one, or a set": of("pairs", lambda r: (r["named"] or r["in_a_set"]) and not r["all_named"]
                                   and not r["wrong"]),
        "pairs: a name or set without a cause": of("pairs", lambda r: r["wrong"]),
        "foreign: refused (no name, not complete)": of("foreign", lambda r: not r["any_name"]
                                                       and r["verdict"] != "complete"),
        "foreign: complete": of("foreign", lambda r: r["verdict"] == "complete"),
        "foreign: a name or set": of("foreign", lambda r: r["any_name"]),
        "nothing missing: complete": of("none", lambda r: r["verdict"] == "complete"),
        "nothing missing: no name": of("none", lambda r: not r["any_name"]),
        "compound: a cause named": of("compound", lambda r: r["named"]),
        "compound: a cause named or in a set": of("compound", lambda r: r["named"] or r["in_a_set"]),
        "compound: a name or set without a cause": of("compound", lambda r: r["wrong"]),
        "all: campaigns with a name or set without a cause": rate(sum(1 for r in rows if r["wrong"]), len(rows)),
        "all: names and sets that hold a cause": rate(sum(c["right"] for c in names), len(names)),
    }
    reliability = []
    for low, high in zip(edges, edges[1:]):
        inside = [c for c in claims if (c["name"] or c["suggested"]) and c["confidence"] is not None
                  and low <= c["confidence"] and (c["confidence"] < high or high == edges[-1])]
        if inside:
            reliability.append({"from": low, "to": high, "right": rate(sum(c["right"] for c in inside), len(inside)),
                                "mean_confidence": sum(c["confidence"] for c in inside) / len(inside)})
    return {"campaigns": len(answers), "diagnosed": len(rows), "limit": ended.count("limit"),
            "failed": ended.count("failed"), "rates": rates, "reliability": reliability, "outcomes": rows}


def column(result):
    """Cells of the page's table, by row."""
    rates = result["rates"]

    def hits(key):
        return rates[key]["hits"]

    def of(key):
        return f"{hits(key)} of {rates[key]['trials']}"

    ended = [f"{result[key]} {words}" for key, words in (("limit", "at the time limit"), ("failed", "failed")) if result[key]]
    spurious = hits("plain: right, with a second name that is not in the truth")
    return {
        "diagnosed": ", ".join([f"{result['diagnosed']} of {result['campaigns']}", *ended]),
        "plain: right": of("plain: right") + (f" ({spurious} more with a spurious second name)" if spurious else ""),
        "plain: in a set": of("plain: in a set"),
        "names or sets without a cause, all campaigns": of("all: campaigns with a name or set without a cause"),
        "at or below the noise: right, in a set":
            f"{hits('at or below the noise: right')} and {of('at or below the noise: in a set')}",
        "pairs: both; one, or a set": f"{hits('pairs: both')}; {of('pairs: one, or a set')}, "
                                      f"{hits('pairs: a name or set without a cause')} wrong",
        "foreign refused": f"{of('foreign: refused (no name, not complete)')}, {hits('foreign: complete')} called complete, "
                           f"{hits('foreign: a name or set')} wrong",
        "nothing missing: complete": f"{of('nothing missing: complete')}, no name on {hits('nothing missing: no name')}",
        "three effects and a weak unknown: a cause named, or in a set":
            f"{of('compound: a cause named or in a set')}, {hits('compound: a name or set without a cause')} wrong",
    }


def percent(one):
    if one["trials"] == 0:
        return "- | -"
    return f"{100 * one['hits'] / one['trials']:.0f} | {100 * one['low95']:.0f} to {100 * one['high95']:.0f}"


def section(result):
    """Every rate of one program, the stated probabilities and the names without a cause."""
    lines = [f"## {result['program']}", "",
             f"{result['diagnosed']} of {result['campaigns']} campaigns diagnosed, {result['limit']} ended at the time limit, "
             f"{result['failed']} failed."
             + ("" if result["median_processor_s"] is None else
                f" Median {result['median_processor_s']:.0f} s of one core. Bounds: Clopper and Pearson, 95 %."), "",
             "| what | hits | of | % | bounds % |", "|---|--:|--:|--:|--:|",
             *(f"| {what} | {one['hits']} | {one['trials']} | {percent(one)} |" for what, one in result["rates"].items()), "",
             "Stated probability of names, sets and suggestions:", "",
             "| from | to | mean stated % | hits | of | % | bounds % |", "|--:|--:|--:|--:|--:|--:|--:|",
             *(f"| {row['from']} | {row['to']} | {100 * row['mean_confidence']:.0f} | {row['right']['hits']} | "
               f"{row['right']['trials']} | {percent(row['right'])} |" for row in result["reliability"]), ""]
    wrong = [(row, claim) for row in result["outcomes"] for claim in row["wrong"]]
    if wrong:
        lines += ["Without a cause:", "",
                  *(f"- {row['campaign']} ({' + '.join(row['truth']) or 'nothing missing'}): {' or '.join(claim['set'])}, "
                    f"stated with {claim['confidence']}" for row, claim in wrong), ""]
    return "\n".join(lines)


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def row_of(values):
    return "| " + " | ".join(values) + " |"


def with_column(lines, name, column_cells):
    """The table's lines with one column more, or with the one of that name made again."""
    head = cells(lines[0])
    marks = cells(lines[1])
    rows = [cells(line) for line in lines[2:]]
    if name in head:
        place = head.index(name)
    else:
        place = len(head)
        head.append(name)
        marks.append("--:")
        rows = [row + ["-"] for row in rows]
    known = [row[0] for row in rows]
    rows += [[what] + ["-"] * (len(head) - 1) for what in column_cells if what not in known]
    for row in rows:
        if row[0] in column_cells:
            row[place] = column_cells[row[0]]
    return [row_of(head), "|" + "|".join(marks) + "|", *(row_of(row) for row in rows)]


def with_result(page, result):
    """The page with the result's column in its first table and its section at the end; what else it holds stays."""
    lines = (page.strip() or blank_page.strip()).split("\n")
    first = next(k for k, line in enumerate(lines) if line.startswith("|"))
    last = first
    while last < len(lines) and lines[last].startswith("|"):
        last += 1
    lines[first:last] = with_column(lines[first:last], result["program"], column(result))
    heading = f"## {result['program']}"
    if heading in lines:
        begin = lines.index(heading)
        end = next((k for k in range(begin + 1, len(lines)) if lines[k].startswith("## ")), len(lines))
        del lines[begin:end]
    return "\n".join(lines).rstrip() + "\n\n" + section(result).rstrip() + "\n"
