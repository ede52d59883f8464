# SPDX-License-Identifier: MIT
"""What hedron selftest says of every device, also of those that it finds wrong."""
import json

from harness.page.section import Part
from harness.run.program import run_tool

FOUND = (0, 1, 3)  # exit codes: all are right, one is wrong, none is there


def measure(study):
    """Raises Problem where the program fails."""
    quick = ["--quick"] if study.arguments.quick else []
    study.news("selftest of every device")
    done = run_tool(study.program.path, "selftest", "--json", *quick, accepted=FOUND)
    study.result["certificates"] = json.loads(done.stdout)["certificates"] if done.stdout else []
    return None if study.result["certificates"] else f"{done.stderr.strip()}."


def first_reason(certificate):
    return next((test["reason"] for test in certificate["tests"] if test["reason"]), "")


def fill(section):
    section.table = [["machine", "device", "name", "driver", "compiler", "verdict", "division by fma", "hedron", "seconds",
                      "certificate", "the first difference"]]
    for result in section.results:
        found = result.get("certificates") or []
        for each in found:
            section.table.append([result["machine"]["name"], f"{each['backend']}:{each['index']}", each["name"], each["driver"],
                                  each["compiler"] or "", each["verdict"],
                                  "yes" if any(test["division_by_fma"] for test in each["tests"]) else "", each["hedron"],
                                  f"{each['seconds']:.1f}", each["hash"], first_reason(each)])
        if found:
            right = sum(each["verdict"] == "right" for each in found)
            section.notes.append(f"{result['machine']['name']}: {right} of {len(found)} devices compute rightly, to the last bit.")


PART = Part(0, "Certificates", "What hedron selftest says of every device: whether its arithmetic and known frames have the bytes "
            "that they have everywhere.", measure=measure, fill=fill, lead=5)
