"""Turns what the comparisons print into Markdown tables.

Lines are fields between tabs: `line` TEXT, `part` NAME (what follows belongs to it; what comes before, to all), `agree` NET
KNOTS JOB WHO DIFFERENCE, `found` JOB WHO COUNTS..., `rate` NET KNOTS JOB WHO MEDIAN LEAST LARGEST in million points a second,
`table` TITLE, `row` CELLS... (the first one is the head), `ratio` JOB WHO TIMES: how many times as fast or as small we are.

Usage: tables.py [--record] <RESULTS      (the parts, and the ratios of this kind of processor, go into docs/measured.md)
"""

import argparse
import re
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "tools/docs"))
import measured  # noqa: E402

# Million points a second, for the nets 65x17, 200x200 and 1000x1000.
GOALS = {
    "S random": (30, 15, 5),
    "S ordered": (46, 25, 18),
    "S, Su, Sv random": (15, 7.5, 2.5),
    "S, Su, Sv ordered": (23, 12.5, 9),
    "grid": (None, None, 76),
}
NETS = ["65x17", "200x200", "1000x1000"]
RATIOS = ["processor", "job", "beside", "times", "run"]


def number(value):
    return f"{value:.3g}"


def cell(rate):
    return f"{number(rate[0])} ({number(rate[1])} to {number(rate[2])})"


def row_of(cells):
    return "| " + " | ".join(cells) + " |"


def table_of(head, rows):
    return "\n".join([row_of(head), "|" + "---|" * len(head), *map(row_of, rows)])


class Part:
    """What one comparison printed."""

    def __init__(self, name):
        self.name = name
        self.lines, self.races, self.found, self.tables = [], {}, {}, []
        self.farthest = 0.0, ""
        # how many times as fast or as small we are, by job and peer
        self.times = {}

    def add(self, kind, fields):
        if kind == "line":
            self.lines.append(fields[0])
        elif kind == "agree":
            self.farthest = max(self.farthest, (float(fields[-1]), " ".join(fields[:-1])))
        elif kind == "found":
            self.found[fields[0], fields[1]] = ", ".join(fields[2:])
        elif kind == "rate":
            runs = self.races.setdefault(tuple(fields[:3]), [])
            if fields[3] == "planish":  # the first of its process
                runs.append({})
            runs[-1][fields[3]] = [float(value) for value in fields[4:]]
        elif kind == "ratio":
            self.times[fields[0], fields[1]] = float(fields[2])
        elif kind == "table":
            self.tables.append((fields[0], []))
        elif kind == "row":
            self.tables[-1][1].append(fields)
        else:
            sys.exit(f"tables: no such line: {kind} {fields}")

    def text(self):
        """In Markdown; fills in the ratios of races."""
        blocks = ["\n".join(f"* {line}" for line in self.lines)]
        if any(job in GOALS for _, _, job in self.races):
            blocks.append(f"Largest difference of results: {self.farthest[0]:.1e} ({self.farthest[1]}).")
            blocks.append(self.evaluation())
        if self.found:
            blocks.append(self.projection())
        for title, (head, *rows) in self.tables:
            blocks += [f"{title}:", table_of(head, rows)]
        return "\n\n".join(block for block in blocks if block) + "\n"

    def evaluation(self):
        names = ["SISL", "OpenCASCADE", "FITPACK"]
        rows = []
        for (net, knots, job), runs in self.races.items():
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
            self.times[key] = min([self.times.get(key, ratios[0]), *ratios])
            rows.append([net, knots, job, cell(ours), *cells.values(), number(min(ratios)), met])
        return table_of(["net", "knots", "job", "planish", *names, "ours / fastest peer", "goal"], rows)

    def projection(self):
        rows = []
        for (_, _, job), runs in self.races.items():
            if job in GOALS:
                continue
            for who, rate in runs[0].items():
                ratio = ""
                if who != "planish":
                    self.times[job, who] = runs[0]["planish"][0] / rate[0]
                    ratio = number(self.times[job, who])
                thousands = cell([1000 * value for value in rate])
                rows.append([job, who, thousands, ratio, self.found.get((job, who), "")])
        return table_of(["job", "who", "thousand points a second", "ours / peer", "distances"], rows)


def read(results):
    """What belongs to all, and the parts."""
    parts = [Part("")]
    for text in results:
        kind, *fields = text.rstrip("\n").split("\t")
        if kind == "part":
            parts.append(Part(fields[0]))
        else:
            parts[-1].add(kind, fields)
    return parts[0], parts[1:]


def ratios(page, machine, run, times):
    """All ratios that the page has, those of this processor replaced, and the others of this run added."""
    old = re.findall(r"^\| .*$", measured.between(page, "ratios by processor"), re.MULTILINE)[1:]
    rows = {tuple(cells[:3]): cells for cells in ([cell.strip() for cell in line.split("|")[1:-1]] for line in old)}
    rows |= {(machine, job, who): [machine, job, who, number(value), run] for (job, who), value in times.items()}
    # a stable sort: of one processor the rows stay in their order
    return table_of(RATIOS, sorted(rows.values(), key=lambda cells: cells[0])) + "\n"


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--record", action="store_true")
    is_recorded = arguments.parse_args().record
    common, parts = read(sys.stdin)
    texts = {part.name: part.text() for part in parts}
    print(common.text())
    for name, text in texts.items():
        print(f"{name}:\n\n{text}")
    patterns = r"machine: (.*?\)),", r"planish \S+ at ([^,\s]+),", r"except for fits: (\S+),"
    machine, version, day = (re.search(pattern, "\n".join(common.lines))[1] for pattern in patterns)
    times = {key: value for part in parts for key, value in part.times.items()}
    rows = ratios(measured.PAGE.read_text(), machine, f"{version}, {day}", times)
    print(rows)
    if is_recorded:
        measured.put("peers", common.text())
        for name, text in texts.items():
            measured.put(f"peers, {name}", f"*At {version}, {day}.*\n\n{text}")
        measured.put("ratios by processor", rows)


if __name__ == "__main__":
    main()
