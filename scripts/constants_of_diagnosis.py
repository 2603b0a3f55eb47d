"""The page of the numbers that a diagnosis decides by, from the constants of src/diagnose. See generate_docs.py."""
import os
import re

ROOMS = {
    "judge": "What may be named, from evidence alone. Everything else that decides a name stands in the learned tables, "
             "[results/grades.md](../results/grades.md).",
    "search": "What is tried, kept, compared and taken further.",
    "residual": "What is read off a residual.",
    "signal": "What is read off recordings alone.",
    ".": "Order of the whole, recordings that do not belong together, words.",
}
CONSTANT = re.compile(r"^(?:inline )?constexpr ([\w:<>, ]+?) (\w+) = ([^;]+);(?:\s*// (.*))?$")


def constants(path):
    """(name, value, meaning) of the constants at namespace scope; one comment may stand above several."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    rows, comment, above = [], [], False
    for line in lines:
        found = CONSTANT.match(line)
        if line.startswith("// "):
            comment = comment + [line[3:]] if above else [line[3:]]
            above = True
        elif found and re.search(r"double|int|size_t|float", found[1]) and re.match(r"[\d.]", found[3]):
            meaning = found[4] or " ".join(comment)
            if not meaning:
                raise SystemExit(f"{path}: the constant {found[2]} has no comment, expected one that says what it is")
            rows.append((found[2], found[3], meaning))
            above = False
        else:
            above = False
            if not found:
                comment = []
    return rows


def rooms(root):
    """Room -> [(file, rows)], files without constants left out."""
    result = {}
    base = os.path.join(root, "src", "diagnose")
    for room in ROOMS:
        folder = os.path.join(base, room)
        files = sorted(name for name in os.listdir(folder) if name.endswith((".cpp", ".hpp")) and name != "table_data.cpp")
        found = [(os.path.normpath(os.path.join(room, name)), constants(os.path.join(folder, name))) for name in files]
        result[room] = [(name, rows) for name, rows in found if rows]
    return result


def page(root):
    text = ("# Numbers of a diagnosis\n\nEvery constant of `src/diagnose`, with what the source says of it. "
            "[diagnosis.md](diagnosis.md) says how they act together.\n")
    for room, files in rooms(root).items():
        count = sum(len(rows) for _, rows in files)
        text += f"\n## {'src/diagnose' if room == '.' else room}\n\n{ROOMS[room]} {count} constants.\n\n"
        text += "| file | constant | value | what it is |\n|---|---|---|---|\n"
        for name, rows in files:
            for constant, value, meaning in rows:
                cells = (f"`{name}`", f"`{constant}`", f"`{value}`", meaning.replace("|", r"\|"))
                text += "| " + " | ".join(cells) + " |\n"
    return text
