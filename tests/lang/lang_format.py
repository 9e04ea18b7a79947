# The form of the tests here, in a module of its own so that lit's worker processes can load it.
import os

import lit.formats
import lit.Test
import lit.util


class LangTest(lit.formats.FileBasedTest):
    """Every .lua file is a test: lang_test runs it, with --refused those of the folder refused/, --malformed likewise."""

    def execute(self, test, lit_config):
        path = test.getSourcePath()
        folder = os.path.basename(os.path.dirname(path))
        kind = ["--" + folder] if folder in ("refused", "malformed") else []
        command = [os.path.join(lit_config.params["bin"], "lang_test"), *kind, path]
        out, err, status = lit.util.executeCommand(command, timeout=300)
        return (lit.Test.PASS, "") if status == 0 else (lit.Test.FAIL, out + err)
