"""Every text of the workbench has a German one, and none is left over: python3 translations.py

Words that come from the library may lack one: they are shown in English then.
"""

import ast
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent / "freecad" / "Planish"
#: Words that come from the library: the stages of long calls and the remarks of fits.
ENUMERATIONS = ("planish_stage", "planish_remark")


def shown():
    """What is handed to `tr` and `translate`, and the texts of commands and panels."""
    texts = set()
    for path in HERE.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if not isinstance(node, ast.Call):
                continue
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            wanted = {"tr": (0,), "translate": (0,), "_at_once": (0,), "Command": (1, 2)}.get(name, ())
            given = [node.args[k] for k in wanted if k < len(node.args)]
            texts |= {argument.value for argument in given if isinstance(argument, ast.Constant)}
    for node in ast.walk(ast.parse((HERE / "panel.py").read_text())):
        if isinstance(node, ast.FunctionDef) and node.name == "_options":
            rows = [part for part in ast.walk(node) if isinstance(part, ast.Tuple) and len(part.elts) == 3]
            texts |= {row.elts[1].value for row in rows if isinstance(row.elts[1], ast.Constant)}
    page = ElementTree.parse(HERE / "resources" / "preferences.ui").getroot()
    texts |= {text.text for text in page.iter("string") if text.get("notr") is None}
    return texts - {"Planish"}  # the context of most of them


def library_words():
    abi = HERE.parents[2] / "python" / "planish" / "_abi.py"
    for node in ast.parse(abi.read_text()).body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "ENUMERATIONS":
            words = ast.literal_eval(node.value)
            return {word.replace("_", " ") for name in ENUMERATIONS for word in words[name]}
    raise AssertionError(f"{abi} has no enumerations")


def translated():
    root = ElementTree.parse(HERE / "resources" / "translations" / "Planish_de.ts").getroot()
    messages = {message.findtext("source"): message.findtext("translation") for message in root.iter("message")}
    assert all(messages.values()), [source for source, text in messages.items() if not text]
    return messages


def compiled():
    """The German texts that the compiled file holds, in whatever order: strings of UTF-16."""
    return (HERE / "resources" / "translations" / "Planish_de.qm").read_bytes()


missing, left = shown() - set(translated()), set(translated()) - shown() - library_words()
if missing or left:
    sys.exit(f"translations: without a German text: {sorted(missing)}; not shown: {sorted(left)}")
old = [text for text in translated().values() if text.encode("utf-16-be") not in compiled()]
if old:
    sys.exit(f"translations: lrelease Planish_de.ts anew, these are not in Planish_de.qm: {old}")
print(f"translations: {len(translated())} texts")
