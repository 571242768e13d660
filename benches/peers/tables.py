"""Turns what the comparisons print into Markdown tables.

Lines are fields between tabs: `line` TEXT, `agree` NET KNOTS JOB WHO DIFFERENCE, `found` JOB WHO COUNTS...,
`rate` NET KNOTS JOB WHO MEDIAN LEAST LARGEST in million points a second, `table` TITLE, `row` CELLS... (the first
one is the head).

Usage: tables.py <RESULTS
"""

import sys

# Million points a second, for the nets 65x17, 200x200 and 1000x1000.
GOALS = {
    "S random": (30, 15, 5),
    "S ordered": (46, 25, 18),
    "S, Su, Sv random": (15, 7.5, 2.5),
    "S, Su, Sv ordered": (23, 12.5, 9),
    "grid": (None, None, 76),
}
NETS = ["65x17", "200x200", "1000x1000"]


def number(value):
    return f"{value:.3g}"


def cell(rate):
    return f"{number(rate[0])} ({number(rate[1])} to {number(rate[2])})"


def print_row(cells):
    print("| " + " | ".join(cells) + " |")


def print_head(cells):
    print()
    print_row(cells)
    print("|" + "---|" * len(cells))


def print_evaluation(races):
    peers = ["SISL", "OpenCASCADE", "FITPACK"]
    print_head(["net", "knots", "job", "planish", *peers, "ours / fastest peer", "goal"])
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
        print_row([net, knots, job, cell(ours), *cells.values(), number(min(ratios)), met])


def print_projection(races, found):
    print_head(["job", "who", "thousand points a second", "ours / peer", "distances"])
    for (_, _, job), runs in races.items():
        if job in GOALS:
            continue
        for who, rate in runs[0].items():
            ratio = "" if who == "planish" else number(runs[0]["planish"][0] / rate[0])
            thousands = cell([1000 * value for value in rate])
            print_row([job, who, thousands, ratio, found.get((job, who), "")])


def main():
    races, found, farthest, blocks = {}, {}, (0.0, ""), []
    for text in sys.stdin:
        kind, *fields = text.rstrip("\n").split("\t")
        if kind == "line":
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
        elif kind == "table":
            blocks.append((fields[0], []))
        elif kind == "row":
            blocks[-1][1].append(fields)
        else:
            sys.exit(f"tables: no such line: {text}")
    if any(job in GOALS for _, _, job in races):
        print(f"\nLargest difference of results: {farthest[0]:.1e} ({farthest[1]}).")
        print_evaluation(races)
    if found:
        print_projection(races, found)
    for title, (head, *rows) in blocks:
        print(f"\n{title}")
        print_head(head)
        for row in rows:
            print_row(row)


if __name__ == "__main__":
    main()
