"""Turns what the comparisons print into Markdown tables.

Lines are fields between tabs: `line` TEXT, `agree` NET KNOTS JOB WHO DIFFERENCE, `found` JOB WHO COUNTS...,
`rate` NET KNOTS JOB WHO MEDIAN LEAST LARGEST in million points a second, `table` TITLE, `row` CELLS... (the first
one is the head), `ratio` JOB WHO TIMES: how many times as fast or as small we are.

Usage: tables.py [--record PAGE] <RESULTS      (in the page the ratios of this kind of processor are put in place)
"""

import argparse
import re
import sys
from pathlib import Path

# Million points a second, for the nets 65x17, 200x200 and 1000x1000.
GOALS = {
    "S random": (30, 15, 5),
    "S ordered": (46, 25, 18),
    "S, Su, Sv random": (15, 7.5, 2.5),
    "S, Su, Sv ordered": (23, 12.5, 9),
    "grid": (None, None, 76),
}
NETS = ["65x17", "200x200", "1000x1000"]
# Between them the ratios stand in the page.
HEAD = ["processor", "job", "beside", "times", "run"]
MARKS = "<!-- ratios by processor -->\n", "<!-- end of ratios -->\n"


def number(value):
    return f"{value:.3g}"


def cell(rate):
    return f"{number(rate[0])} ({number(rate[1])} to {number(rate[2])})"


def row_of(cells):
    return "| " + " | ".join(cells) + " |"


def head_of(cells):
    return f"{row_of(cells)}\n|" + "---|" * len(cells)


def print_row(cells):
    print(row_of(cells))


def print_head(cells):
    print()
    print(head_of(cells))


def print_evaluation(races, times):
    names = ["SISL", "OpenCASCADE", "FITPACK"]
    print_head(["net", "knots", "job", "planish", *names, "ours / fastest peer", "goal"])
    for (net, knots, job), runs in races.items():
        if job not in GOALS:
            continue
        cells = {"SISL": "-", "OCCT": "-", "FITPACK": "-"}
        ratios = []
        for process in runs:
            ours = process["planish"]
            for family in cells:
                peers = {who: rate for who, rate in process.items() if who.startswith(family)}
                if peers:
                    best = max(peers, key=lambda who: peers[who][0])
                    form = best.removeprefix(family).strip()
                    cells[family] = f"{cell(peers[best])} {form}"
                    ratios.append(ours[0] / peers[best][0])
        ours, goal = runs[0]["planish"], GOALS[job][NETS.index(net)]
        met = "-" if goal is None else f"{number(goal)}, {'met' if ours[0] >= goal else 'missed'}"
        key = f"{job}, {net}", "the fastest of " + ", ".join(names)
        times[key] = min([times.get(key, ratios[0]), *ratios])
        print_row([net, knots, job, cell(ours), *cells.values(), number(min(ratios)), met])


def print_projection(races, found, times):
    print_head(["job", "who", "thousand points a second", "ours / peer", "distances"])
    for (_, _, job), runs in races.items():
        if job in GOALS:
            continue
        for who, rate in runs[0].items():
            ratio = ""
            if who != "planish":
                times[job, who] = runs[0]["planish"][0] / rate[0]
                ratio = number(times[job, who])
            thousands = cell([1000 * value for value in rate])
            print_row([job, who, thousands, ratio, found.get((job, who), "")])


def rows_of(machine, run, times):
    return {(machine, job, who): row_of([machine, job, who, number(value), run]) for (job, who), value in times.items()}


def recorded(page, rows):
    """The page with rows of the same processor, job and peer replaced, and the others added."""
    before, rest = page.split(MARKS[0])
    table, after = rest.split(MARKS[1])
    old = [line for line in table.splitlines()[2:] if line]
    all_rows = {tuple(cell.strip() for cell in line.split("|")[1:4]): line for line in old} | rows
    # a stable sort: of one processor the rows stay in their order
    lines = [line for _, line in sorted(all_rows.items(), key=lambda item: item[0][0])]
    return before + MARKS[0] + "\n".join([head_of(HEAD), *lines]) + "\n" + MARKS[1] + after


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--record", type=Path)
    page = arguments.parse_args().record
    races, found, farthest, blocks, times, lines = {}, {}, (0.0, ""), [], {}, []
    for text in sys.stdin:
        kind, *fields = text.rstrip("\n").split("\t")
        if kind == "line":
            lines.append(fields[0])
            print(f"* {fields[0]}")
        elif kind == "agree":
            farthest = max(farthest, (float(fields[-1]), " ".join(fields[:-1])))
        elif kind == "found":
            found[fields[0], fields[1]] = ", ".join(fields[2:])
        elif kind == "rate":
            runs = races.setdefault(tuple(fields[:3]), [])
            if fields[3] == "planish":  # the first of its process
                runs.append({})
            runs[-1][fields[3]] = [float(value) for value in fields[4:]]
        elif kind == "ratio":
            times[fields[0], fields[1]] = float(fields[2])
        elif kind == "table":
            blocks.append((fields[0], []))
        elif kind == "row":
            blocks[-1][1].append(fields)
        else:
            sys.exit(f"tables: no such line: {text}")
    if any(job in GOALS for _, _, job in races):
        print(f"\nLargest difference of results: {farthest[0]:.1e} ({farthest[1]}).")
        print_evaluation(races, times)
    if found:
        print_projection(races, found, times)
    for title, (head, *rows) in blocks:
        print(f"\n{title}")
        print_head(head)
        for row in rows:
            print_row(row)
    if times:
        patterns = r"machine: (.*?\)),", r"planish \S+ at (\S+),", r"except for fits: (\S+),"
        machine, version, day = (re.search(pattern, "\n".join(lines))[1] for pattern in patterns)
        rows = rows_of(machine, f"{version}, {day}", times)
        print_head(HEAD)
        print("\n".join(rows.values()))
        if page:
            page.write_text(recorded(page.read_text(), rows))


if __name__ == "__main__":
    main()
