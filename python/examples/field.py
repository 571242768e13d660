"""A field on nodes is fitted once and updated in every time step; its values and gradient go to other points.

Output: largest error below 1e-3: True
"""

import numpy as np

import planish

x, y = np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 60), indexing="ij")
uv = np.stack([x, y], axis=-1).reshape(-1, 2)


def temperature(places, time):
    return np.exp(-time) * np.sin(3 * places[:, 0]) * np.cos(2 * places[:, 1])


fitter = planish.FieldFitter(uv=uv)
field = fitter.fit(temperature(uv, 0.0))
sensors = np.random.default_rng(2).random((200, 2))
errors = []
for time in np.linspace(0, 1, 11):
    fitter.update(field, temperature(uv, time))
    errors.append(np.abs(field.ev(*sensors.T) - temperature(sensors, time)).max())
print("largest error below 1e-3:", max(errors) < 1e-3)
