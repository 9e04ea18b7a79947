# What the programs print and how they end: RUN lines and FileCheck.
import os
import sys

import lit.formats

bin_folder = lit_config.params["bin"]
source_folder = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

config.name = "tools"
config.suffixes = [".test", ".lua"]
config.excludes = ["inputs"]
config.test_format = lit.formats.ShTest(execute_external=False)
config.test_source_root = os.path.dirname(__file__)
config.test_exec_root = lit_config.params["out"]
config.environment["PATH"] = bin_folder + os.pathsep + os.environ["PATH"]
config.environment["NO_COLOR"] = "1"
config.environment["XDG_CACHE_HOME"] = os.path.join(config.test_exec_root, "cache")
config.substitutions += [
    ("%shaderc", os.path.join(bin_folder, "shaderc")),
    ("%moonbench", os.path.join(bin_folder, "moonbench")),
    ("%inputs", os.path.join(config.test_source_root, "inputs")),
    ("%shaders", os.path.join(source_folder, "shaders")),
    ("%status", os.path.join(config.test_source_root, "status.sh")),
    ("%python", sys.executable),
    ("FileCheck", lit_config.params["filecheck"]),
]
