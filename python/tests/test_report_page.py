"""The report in a real browser: it draws in the right colours, and its console is silent."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from conftest import sheet

import planish

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
CONVERT = shutil.which("convert")
FLAGS = (
    "--headless --no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-component-update "
    "--disable-sync --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=1200,800 --hide-scrollbars "
    "--virtual-time-budget=4000 --enable-logging=stderr"
).split()


def pixels(path):
    """The picture as (height, width, 3) bytes."""
    size = subprocess.run([CONVERT, path, "-format", "%w %h", "info:"], capture_output=True, check=True).stdout.split()
    raw = subprocess.run([CONVERT, path, "-depth", "8", "rgb:-"], capture_output=True, check=True).stdout
    return np.frombuffer(raw, np.uint8).reshape(int(size[1]), int(size[0]), 3).astype(int)


@pytest.mark.skipif(not (BROWSER and CONVERT), reason="no chromium or imagemagick")
def test_the_page_draws_and_its_console_is_silent(tmp_path):
    points, triangles = sheet(40, 30)
    mesh = planish.Mesh(points, triangles)
    surface = planish.fit(mesh, 1e-2, "tensor")
    # half of the mesh a little above the surface, half below
    lifted = points + [0, 0, 1] * np.where(points[:, :1] < 1, 0.02, -0.02)
    page, picture = tmp_path / "report.html", tmp_path / "report.png"
    surface.write_report(page, planish.Mesh(lifted, triangles), tolerance=0.03, tolerance_scale="absolute")
    command = [BROWSER, *FLAGS, f"--user-data-dir={tmp_path / 'profile'}", f"--screenshot={picture}", page.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    complaints = [line for line in done.stderr.splitlines() if re.search(r"CONSOLE", line)]
    assert not complaints, complaints
    image = pixels(picture)
    view = image[:, : 1200 - 420]
    red, green, blue = view[..., 0], view[..., 1], view[..., 2]
    # outside is red to yellow, inside blue to turquoise; the background is grey
    outside = (red > blue + 60).mean()
    inside = (blue > red + 60).mean()
    assert outside > 0.03 and inside > 0.03, (outside, inside)
