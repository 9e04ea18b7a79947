# The contract of moonbench --json and --plot.
import json
import sys
import xml.dom.minidom

rows = json.load(open(sys.argv[1]))
assert [row["mode"] for row in rows] == ["lua", "scalar", "simd"] * 2, rows
for row in rows:
    assert {"shader", "entry", "mode", "width", "mpoints_per_second", "ratio_to_lua", "compile_ms",
            "max_difference"} <= set(row)
    assert row["entry"] == "height" and row["mpoints_per_second"] > 0
    assert row["width"] == 1 or row["mode"] == "simd"
    assert row["max_difference"] < 1e-4, row
assert rows[0]["ratio_to_lua"] == 1
xml.dom.minidom.parse(sys.argv[2])
