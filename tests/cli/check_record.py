#!/usr/bin/python3
"""check_record.py GNATHOS FILE...: every file is a record that passes the JSON schema which `gnathos help --schema KIND`
prints, and would not with a field more or a field less in any of its objects."""
import copy, json, subprocess, sys

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
KNOWN = {"$schema", "title", "description", "type", "const", "enum", "properties", "required", "additionalProperties",
         "items", "minItems", "maxItems"}


def is_type(value, name):
    if name in ("number", "integer"):
        return not isinstance(value, bool) and isinstance(value, int if name == "integer" else (int, float))
    return isinstance(value, TYPES[name])


def breaches(value, schema, path=""):
    """What the value has against the schema, as a list of lines."""
    assert set(schema) <= KNOWN, f"{path}: this checker does not know {set(schema) - KNOWN}"
    types = schema.get("type", [])
    types = types if isinstance(types, list) else [types]
    found = []
    if types and not any(is_type(value, t) for t in types):
        return [f"{path}: {value!r:.60} is no {' or '.join(types)}"]
    if "const" in schema and value != schema["const"]:
        found.append(f"{path}: {value!r:.60} is not {schema['const']!r}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{path}: {value!r:.60} is none of {schema['enum']}")
    if isinstance(value, dict):
        own, others = schema.get("properties", {}), schema.get("additionalProperties", True)
        found += [f"{path}: lacks {name}" for name in schema.get("required", []) if name not in value]
        for name, one in value.items():
            if name in own or isinstance(others, dict):
                found += breaches(one, own.get(name, others), f"{path}.{name}")
            elif not others:
                found.append(f"{path}.{name}: is not in the schema")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{path}: has {len(value)} items")
        for i, one in enumerate(value):
            found += breaches(one, schema.get("items", {}), f"{path}[{i}]")
    return found


def objects(value, schema):
    """The objects with fields of their own, each with its schema; of a list the first item's."""
    if isinstance(value, dict):
        if schema.get("additionalProperties") is False:
            yield value, schema
        for name, one in value.items():
            yield from objects(one, schema.get("properties", {}).get(name, schema.get("additionalProperties")))
    elif isinstance(value, list) and value:
        yield from objects(value[0], schema["items"])


def check(gnathos, path):
    record = json.load(open(path))
    assert record.get("gnathos") == 1 and record.get("kind") and record.get("version"), f"{path}: no head of a record"
    text = subprocess.run([gnathos, "help", "--schema", record["kind"]], check=True, capture_output=True, text=True)
    schema = json.loads(text.stdout)
    found = breaches(record, schema)
    assert not found, f"{path}:\n" + "\n".join(found[:20])
    count = 0
    for one, own in objects(record, schema):
        one["undocumented"] = 1
        assert breaches(one, own), f"{path}: a field too many passes"
        del one["undocumented"]
        for name in own["required"]:
            less = copy.copy(one)
            del less[name]
            assert breaches(less, own), f"{path}: without {name} it passes"
        count += 1
    print(f"{path}: {record['kind']}, {count} objects")


for name in sys.argv[2:]:
    check(sys.argv[1], name)
