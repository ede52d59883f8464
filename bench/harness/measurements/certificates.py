# SPDX-License-Identifier: MIT
"""Reports of hedron selftest of every device, including those that it finds wrong."""
import json

from harness.page.section import Part
from harness.run.program import run_tool

FOUND = (0, 1, 3)  # exit codes: all are right, one is wrong, there is none


def measure(study):
    """Returns the reports; raises Problem if the program fails."""
    quick = ["--quick"] if study.arguments.quick else []
    study.news("selftest of every device")
    done = run_tool(study.program.path, "selftest", "--json", *quick, accepted=FOUND)
    study.result["certificates"] = json.loads(done.stdout)["certificates"] if done.stdout else []
    return None if study.result["certificates"] else f"{done.stderr.strip()}."


def first_reason(certificate):
    return next((test["reason"] for test in certificate["tests"] if test["reason"]), "")


def fill(section):
    section.table = [["machine", "device", "name", "driver", "compiler", "verdict", "division by fma", "hedron", "seconds",
                      "the first difference"]]
    for result in section.results:
        found = result.get("certificates") or []
        for each in found:
            section.table.append([result["machine"]["name"], f"{each['backend']}:{each['index']}", each["name"], each["driver"],
                                  each["compiler"] or "", each["verdict"],
                                  "yes" if any(test["division_by_fma"] for test in each["tests"]) else "", each["hedron"],
                                  f"{each['seconds']:.1f}", first_reason(each)])
        if found:
            right = sum(each["verdict"] == "right" for each in found)
            section.notes.append(f"{result['machine']['name']}: {right} of {len(found)} devices pass the self-test.")


PART = Part(0, "Self-tests", "Reports of hedron selftest: whether arithmetic and known frames of a device have the bytes that all "
            "devices must give.", measure=measure, fill=fill, lead=5)
