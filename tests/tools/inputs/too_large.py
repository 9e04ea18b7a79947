"""Prints a shader of many operations, or, with any argument, one with a name as long as a file."""
import sys

print("function height(p)\n  local x = p.x")
if len(sys.argv) > 1:
    print("  x = x\n  + " + "n" * 100000)
else:
    for _ in range(40000):
        print("  x = x * p.y + p.z * 0.5 - x * x * p.z")
print("  return x\nend")
