# SPDX-License-Identifier: MIT
"""What hedron selftest says of every device, also of those that it finds wrong."""
import html
import json

from harness.page import answer
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
            section.notes.append(f"{result['machine']['name']}: {right} of {len(found)} devices compute rightly, to the last bit.")


def answers(results):
    """Only where devices were asked."""
    found = [(result, each) for result in results for each in result.get("certificates") or []]
    wrong = [f"{each['backend']}:{each['index']} of {result['machine']['name']}" for result, each in found
             if each["verdict"] != "right"]
    right = len(found) - len(wrong)
    if found:
        yield (f"The self-test finds {answer.figure('devices_right', right, f'{right}')} of {len(found)} devices right{html.escape(', but not ' + ', '.join(wrong)) if wrong else ''}.")


PART = Part(0, "Certificates", "What hedron selftest says of every device: whether its arithmetic and known frames have the bytes "
            "that they have everywhere.", measure=measure, fill=fill, answer=answers, lead=5)
