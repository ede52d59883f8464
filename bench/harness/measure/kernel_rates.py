# SPDX-License-Identifier: MIT
"""The rates of the kernels' hot loops, and the operations that their machine code executes."""
import re
import shutil
import subprocess

from harness.run.program import Problem, run_tool

INSTRUCTION = re.compile(r"^\s*([0-9a-f]+):\t(?:(?:notrack|bnd|rep|data16) )?(\S+)\s*([^#<]*)")
# Instructions that move numbers and compute nothing, except that masked ones select.
MOVES = ("vmov", "vbroadcast", "vpbroadcast", "vextract", "vinsert", "vperm", "vshuf", "vpshuf", "vunpck",
         "vpunpck", "vgather", "vpgather", "vpinsr", "vpextr", "vzero", "vcompress", "vpcompress")


def lanes_of(name, operands):
    """Returns the count of 32-bit numbers that the instruction works on."""
    if name.endswith(("ss", "sd", "si")):
        return 1
    return next((lanes for register, lanes in (("zmm", 16), ("ymm", 8), ("xmm", 4)) if register in operands), 0)


def weigh(name, operands):
    """Returns (operations, issue slots) of an instruction. An operation is one lane of an addition, multiplication, division,
    root, comparison, selection, conversion or bitwise function of a vector register; a fused multiply-add is two. Loads,
    moves, mask registers and the integer unit count as none; mask instructions still take slots of the vector units."""
    if name.startswith("k"):
        return 0, 1
    # A register combined with itself gives zero without being executed.
    is_zeroing = "xor" in name and len(set(re.findall(r"%[xyz]mm\d+", operands))) == 1
    if not name.startswith("v") or is_zeroing or name.startswith(MOVES) and "{%k" not in operands:
        return 0, 0
    each = 2 if name.startswith(("vfmadd", "vfmsub", "vfnmadd", "vfnmsub")) else 1
    return each * lanes_of(name, operands), 1


def disassemble(program, symbol):
    """Returns [(offset, name, operands)] of a function."""
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", f"--disassemble={symbol}", program],
                             capture_output=True, text=True, check=True).stdout
    found = [INSTRUCTION.match(line) for line in listing.splitlines()]
    places = [(int(match[1], 16), match[2], match[3]) for match in found if match]
    if not places:
        raise Problem(1, f"objdump finds no function {symbol} in {program}")
    return [(address - places[0][0], name, operands) for address, name, operands in places]


def add_up(code, times):
    """Returns the executed operations, by the offsets' counts."""
    total = dict.fromkeys(("instructions", "operations", "slots", "divisions"), 0)
    for offset, name, operands in code:
        for key, each in zip(total, (1, *weigh(name, operands), name.startswith(("vdiv", "vsqrt")))):
            total[key] += times.get(offset, 0) * each
    return total


def parse(program, text):
    """Returns {"instruction_set", "lanes", "rates": {name: [...]}, "counted": {name: operations for each unit of it},
    "uncounted": [...]}."""
    result = {"instruction_set": None, "lanes": None, "rates": {}, "counted": {}, "uncounted": []}
    times, works = {}, {}
    for what, name, *rest in map(str.split, text.splitlines()):
        if what == "build":
            result["instruction_set"], result["lanes"] = name, int(rest[0])
        elif what == "rate":
            result["rates"].setdefault(name, []).append(float(rest[1]))
        elif what == "step":
            times.setdefault(name, {})[int(rest[0])] = int(rest[1])
        elif what == "uncounted":
            result["uncounted"].append(name)
        elif what == "counted":
            works[name] = rest
    for name, (instruction_set, lanes, symbol, amount) in works.items():
        total = add_up(disassemble(program, symbol), times.get(name, {}))
        result["counted"][name] = {"instruction_set": instruction_set, "lanes": int(lanes), "amount": float(amount),
                                   **{f"{key}_each": value / float(amount) for key, value in total.items()}}
    return result


def run(program, scenes, seconds, rounds, counts=False, limit=None):
    """Returns the program's output. Raises Problem with the reason if it fails or takes more than `limit` seconds: counting
    steps through instructions, slowly on a busy machine."""
    rates_program = program.beside("bench/hedron_kernel_rates")
    if counts and shutil.which("objdump") is None:
        raise Problem(3, "objdump is not installed; its package is binutils")
    done = run_tool(rates_program, "--seconds", seconds, "--rounds", rounds, *(["--count"] if counts else []), *scenes,
                    limit=limit)
    return parse(rates_program, done.stdout)


def peaks(found):
    """Returns the machine's vector instructions a second in independent chains, of either kind."""
    return [max(both) for both in zip(found["rates"]["peak:fma"], found["rates"]["peak:mul_add"])]
