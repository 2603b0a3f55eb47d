"""Checks a modelDescription.xml against the rules of FMI 2.0 (section 2.2): elements in their order, attributes and
their types, names and indices. Prints what is wrong; exit status 1 then."""

import re
import sys
import xml.etree.ElementTree as xml

wrong = []


def check(holds, what):
    if not holds:
        wrong.append(what)


def attributes(element, required, optional):
    for name in required:
        check(name in element.attrib, f"<{element.tag}> without {name}")
    for name in element.attrib:
        check(name in required or name in optional, f"<{element.tag}> with an unknown attribute {name}")


def truth(element, *names):
    for name in names:
        check(element.get(name, "true") in ("true", "false"), f"{name} is not true or false")


root = xml.parse(sys.argv[1]).getroot()
check(root.tag == "fmiModelDescription", "the root is not fmiModelDescription")
attributes(root, ["fmiVersion", "modelName", "guid"],
           ["description", "author", "version", "copyright", "license", "generationTool", "generationDateAndTime",
            "variableNamingConvention", "numberOfEventIndicators"])
check(root.get("fmiVersion") == "2.0", "fmiVersion is not 2.0")
check(root.get("variableNamingConvention", "flat") in ("flat", "structured"), "variableNamingConvention")
date = root.get("generationDateAndTime")
check(date is None or re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", date), "generationDateAndTime")
order = ["ModelExchange", "CoSimulation", "UnitDefinitions", "TypeDefinitions", "LogCategories", "DefaultExperiment",
         "VendorAnnotations", "ModelVariables", "ModelStructure"]
tags = [child.tag for child in root]
check(tags == sorted(tags, key=order.index), "elements are not in the order of the schema")
check(len(tags) == len(set(tags)), "an element occurs twice")
for tag in ("CoSimulation", "ModelVariables", "ModelStructure"):
    check(tag in tags, f"no {tag}")

slave = root.find("CoSimulation")
flags = ["needsExecutionTool", "canHandleVariableCommunicationStepSize", "canInterpolateInputs",
         "canRunAsynchronuously", "canBeInstantiatedOnlyOncePerProcess", "canNotUseMemoryManagementFunctions",
         "canGetAndSetFMUstate", "canSerializeFMUstate", "providesDirectionalDerivative"]
attributes(slave, ["modelIdentifier"], [*flags, "maxOutputDerivativeOrder"])
truth(slave, *flags)
check(re.fullmatch(r"[A-Za-z_]\w*", slave.get("modelIdentifier")), "modelIdentifier is not an identifier of C")
files = slave.find("SourceFiles")
check(files is not None and len(files) > 0, "no source files")

units = set()
for unit in root.find("UnitDefinitions"):
    attributes(unit, ["name"], [])
    check(unit.get("name") not in units, f"unit {unit.get('name')} occurs twice")
    units.add(unit.get("name"))
    for base in unit.findall("BaseUnit"):
        attributes(base, [], ["kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset"])

names = set()
references = set()
variables = list(root.find("ModelVariables"))
for variable in variables:
    attributes(variable, ["name", "valueReference"], ["description", "causality", "variability", "initial",
                                                      "canHandleMultipleSetPerTimeInstant"])
    name = variable.get("name")
    check(name not in names, f"variable {name} occurs twice")
    names.add(name)
    check(len(variable) == 1 and variable[0].tag in ("Real", "Integer", "Boolean", "String", "Enumeration"),
          f"{name} has no type")
    kind = variable[0]
    reference = (kind.tag, int(variable.get("valueReference")))
    check(reference not in references, f"{name} shares its value reference")
    references.add(reference)
    attributes(kind, [], ["declaredType", "quantity", "unit", "displayUnit", "relativeQuantity", "min", "max",
                          "nominal", "unbounded", "start", "derivative", "reinit"])
    check(kind.get("unit") is None or kind.get("unit") in units, f"{name} has an undefined unit")
    causality = variable.get("causality", "local")
    variability = variable.get("variability", "continuous")
    initial = variable.get("initial")
    check(variability != "continuous" or kind.tag == "Real", f"{name} is continuous and not real")
    if causality == "input":
        check(initial is None, f"input {name} with initial")
        check("start" in kind.attrib, f"input {name} without start")
        check(variability in ("discrete", "continuous"), f"input {name} is {variability}")
    elif causality == "parameter":
        check(variability in ("fixed", "tunable"), f"parameter {name} is {variability}")
        check(initial in (None, "exact") and "start" in kind.attrib, f"parameter {name} without start")
    elif causality == "output":
        check(initial in (None, "exact", "approx", "calculated"), f"output {name}: initial")
        exact = initial in ("exact", "approx")
        check(exact == ("start" in kind.attrib), f"output {name}: start and initial do not agree")

outputs = [k for k, v in enumerate(variables, 1) if v.get("causality") == "output"]
structure = root.find("ModelStructure")
check([child.tag for child in structure] == [t for t in ("Outputs", "Derivatives", "InitialUnknowns")
                                             if structure.find(t) is not None], "ModelStructure is out of order")


def unknowns(tag, known):
    result = []
    for unknown in structure.find(tag):
        attributes(unknown, ["index"], ["dependencies", "dependenciesKind"])
        result.append(int(unknown.get("index")))
        dependencies = [int(word) for word in unknown.get("dependencies", "").split()]
        check(dependencies == sorted(set(dependencies)), f"{tag}: dependencies are not ordered")
        for index in dependencies:
            check(1 <= index <= len(variables) and known(variables[index - 1]), f"{tag}: depends on {index}")
    check(result == sorted(set(result)), f"{tag} is not ordered")
    return result


check(unknowns("Outputs", lambda v: v.get("causality") == "input") == outputs, "Outputs does not list the outputs")
calculated = [k for k in outputs if variables[k - 1].get("initial", "calculated") != "exact"]
check(unknowns("InitialUnknowns", lambda v: v.get("causality") in ("input", "parameter")) == calculated,
      "InitialUnknowns does not list the calculated outputs")

print("\n".join(wrong))
sys.exit(1 if wrong else 0)
