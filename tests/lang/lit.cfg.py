# Programs of the dialect that say what they give (README.md).
import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
sys.dont_write_bytecode = True

from lang_format import LangTest

config.name = "lang"
config.suffixes = [".lua"]
config.excludes = ["modules"]  # what the others require
config.test_format = LangTest()
config.test_source_root = os.path.dirname(__file__)
config.test_exec_root = lit_config.params["out"]
