#!/usr/bin/env python3
"""The checks can fail: each is given a tree with a planted offence."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_citations
import check_layers


class Tree(unittest.TestCase):
    """A source tree of the given files, in a temporary folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


class Layers(Tree):
    def offences(self, path, text):
        self.write(path, text)
        return list(check_layers.offences(self.root))

    def test_down_and_sideways_into_the_same_module_is_allowed(self):
        text = "#include <wend/medium/phase.h>\n#include <wend/core/ray.h>\n#include <vector>\n#include <Imath/ImathVec.h>\n"
        self.assertEqual(self.offences("src/wend/medium/grid.cpp", text), [])

    def test_up_is_refused_with_its_place(self):
        found = self.offences("src/wend/medium/grid.cpp", "#include <vector>\n#include <wend/io/volume.h>\n")
        self.assertEqual(len(found), 1)
        self.assertIn("grid.cpp:2: <wend/io/volume.h>: medium (level 3) must not see io (level 7)", found[0])

    def test_odd_spacing_does_not_hide_an_include(self):
        self.assertEqual(len(self.offences("src/wend/core/a.h", "  #  include<wend/stats/moments.h>\n")), 1)

    def test_every_kind_of_source_is_read(self):
        for ending in ("h", "inl", "cpp"):
            self.write(f"src/wend/core/a.{ending}", "#include <wend/io/volume.h>\n")
        self.assertEqual(len(list(check_layers.offences(self.root))), 3)

    def test_modules_of_one_level_do_not_see_each_other(self):
        for module, other in [("planar", "guide"), ("guide", "planar"), ("decision", "planar"), ("decision", "guide")]:
            self.assertFalse(check_layers.may_include(module, other), f"{module} sees {other}")
        self.assertTrue(check_layers.may_include("decision", "adjoint"))

    def test_unknown_modules_and_loose_files_are_refused(self):
        self.assertEqual(len(self.offences("src/wend/misc/a.h", "")), 1)
        self.assertEqual(len(self.offences("src/wend/loose.h", "")), 2)

    def test_quoted_and_unknown_includes_are_refused(self):
        self.assertEqual(len(self.offences("src/wend/io/a.cpp", '#include "volume.h"\n#include <wend/misc/a.h>\n')), 2)


class Citations(Tree):
    def offences(self, path, text):
        self.write("docs/references.bib", "@article{duff2017,\n  title = {x}\n}\n")
        self.write(path, text)
        return list(check_citations.offences(self.root))

    def test_known_keys_pass(self):
        self.assertEqual(self.offences("src/wend/core/a.h", "/// A basis (duff2017, listing 3).\n"), [])

    def test_unknown_keys_are_refused_with_their_place(self):
        found = self.offences("src/wend/core/a.h", "int x;\n/// As nobody1999 did.\n")
        self.assertEqual(len(found), 1)
        self.assertIn("a.h:2: nobody1999", found[0])
        self.assertEqual(len(self.offences("docs/theory.md", "see `nobody1999b` and (nobody2001)\n")), 3)

    def test_every_kind_of_source_is_read(self):
        for ending in ("h", "inl"):
            self.write(f"src/wend/core/a.{ending}", "// As nobody1999 did.\n")
        self.assertEqual(len(self.offences("src/wend/core/a.cpp", "// As nobody1999 did.\n")), 3)

    def test_code_files_and_paths_are_not_citations(self):
        self.assertEqual(self.offences("src/wend/core/a.h", "int nobody1999 = 0;  // see nobody1999.pbrt, a/nobody1999\n"), [])

    def test_double_entries_are_refused(self):
        self.write("docs/references.bib", "@article{duff2017,\n}\n@misc{duff2017,\n}\n")
        self.assertEqual(len(list(check_citations.offences(self.root))), 1)


@unittest.skipUnless(shutil.which("clang-format-14"), "clang-format-14 is absent")
class Format(Tree):
    def test_every_kind_of_source_is_read(self):
        check = Path(__file__).parent / "check_format.sh"
        for folder in ("src", "tests", "bench", "fuzz", "examples"):
            self.write(f"{folder}/a.h", "int x;\n")
        self.assertEqual(subprocess.run([check, self.root], capture_output=True).returncode, 0)
        for ending in ("h", "inl", "cpp"):
            self.write(f"src/b.{ending}", "int   x;\n")
            self.assertNotEqual(subprocess.run([check, self.root], capture_output=True).returncode, 0, ending)
            (self.root / f"src/b.{ending}").unlink()


if __name__ == "__main__":
    unittest.main()
