"""Scenes by the C library from Python: as faces.R."""
import json
import struct
import sys

from rotdyn_objects import candidates, run

with open(sys.argv[1], encoding="utf-8") as file:
    for line in file:
        times, text = line.rstrip("\n").split("\t")
        times = [float(x) for x in times.split(" ")]
        scene = json.loads(text)
        scene.pop("scene_format", None)
        (constructor, arguments), = scene.items()
        report, columns = run(constructor, arguments, times)
        print(json.dumps({
            "model": report.model.decode(), "models": candidates(constructor, arguments, times),
            "columns": {name: [struct.pack(">d", x).hex() for x in values]
                        for name, values in columns.items()}
        }))
