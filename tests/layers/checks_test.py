#!/usr/bin/env python3
"""The checks can fail: each is given a tree with a planted offence."""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[2] / "bench")]
import check_citations
import check_extensions
import check_layers
import check_public
import headers_alone
import measure
import tables


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


class HeadersAlone(Tree):
    def test_each_header_begins_something_that_is_compiled(self):
        self.write("src/wend/core/a.h", "#include <wend/core/b.h>\n")
        self.write("src/wend/core/b.h", "#include <vector>\n#include <wend/core/c.h>\n")
        self.write("src/wend/core/c.h", "")
        self.write("src/wend/core/d.h", "#include <wend/core/e.h>\n")
        self.write("src/wend/core/e.h", "")
        self.write("src/wend/core/c.cpp", "// Words.\n#include <wend/core/d.h>\n#include <wend/core/a.h>\n")
        self.assertEqual(headers_alone.to_compile(self.root, ["core"]), ["wend/core/a.h", "wend/core/c.h"])


class Layers(Tree):
    def offences(self, path, text):
        self.write(path, text)
        return list(check_layers.offences(self.root))

    def test_down_and_sideways_into_the_same_module_is_allowed(self):
        text = "#include <wend/medium/phase.h>\n#include <wend/core/ray.h>\n#include <vector>\n#include <Imath/ImathVec.h>\n"
        self.assertEqual(self.offences("src/wend/medium/grid.cpp", text), [])

    def test_a_source_begins_with_its_own_header(self):
        self.write("src/wend/core/ray.h", "")
        self.assertEqual(self.offences("src/wend/core/ray.cpp", "#include <wend/core/ray.h>\n\n#include <vector>\n"), [])
        found = self.offences("src/wend/core/ray.cpp", "#include <vector>\n#include <wend/core/ray.h>\n")
        self.assertEqual(len(found), 1)
        self.assertIn("not with its own header", found[0])

    def test_tables_of_files_name_what_there_is(self):
        self.write("docs/architecture.md", "Files of `core`:\n\n| files | what |\n|---|---|\n| `ray`, `gone` | `x` |\n\n"
                                           "Beside them `others`:\n| `more` | |\n")
        found = self.offences("src/wend/core/ray.h", "")
        self.assertEqual(len(found), 1)
        self.assertIn("architecture.md:5: core has no file gone", found[0])

    def test_up_is_refused_with_its_place(self):
        found = self.offences("src/wend/medium/grid.cpp", "#include <vector>\n#include <wend/io/volume.h>\n")
        self.assertEqual(len(found), 1)
        self.assertIn("grid.cpp:2: <wend/io/volume.h>: medium (level 3) must not see io (level 7)", found[0])

    def test_odd_spacing_does_not_hide_an_include(self):
        self.assertEqual(len(self.offences("src/wend/core/a.h", "  #  include<wend/stats/moments.h>\n")), 1)

    def test_every_kind_of_source_is_read(self):
        for ending in ("h", "inl", "cpp"):
            self.write(f"src/wend/core/{ending}.{ending}", "#include <wend/io/volume.h>\n")
        self.assertEqual(len(list(check_layers.offences(self.root))), 3)

    def test_modules_of_one_level_do_not_see_each_other(self):
        for module, other in [("planar", "guide"), ("guide", "planar"), ("decision", "planar"), ("decision", "guide")]:
            self.assertFalse(check_layers.may_include(module, other), f"{module} sees {other}")
        self.assertTrue(check_layers.may_include("decision", "adjoint"))

    def test_unknown_modules_and_loose_files_are_refused(self):
        self.assertEqual(len(self.offences("src/wend/misc/a.h", "")), 1)
        self.assertEqual(len(self.offences("src/wend/loose.h", "")), 2)

    def test_the_interface_of_open_pgl_stands_alone(self):
        self.assertEqual(self.offences("src/wend/openpgl/a.cpp", "#include <openpgl/openpgl.h>\n#include <wend/guide/fit.h>\n"), [])
        self.assertEqual(self.offences("src/openpgl/cpp/a.h", "#include <openpgl/data.h>\n#include <vector>\n"), [])
        self.assertEqual(len(self.offences("src/openpgl/cpp/a.h", "#include <wend/guide/fit.h>\n#include \"../data.h\"\n")), 2)
        self.assertEqual(len(self.offences("src/wend/capi/a.cpp", "#include <openpgl/openpgl.h>\n")), 3)

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


class Public(Tree):
    def offences(self, listed):
        self.write("src/wend/guide.hpp", "#include <wend/core/a.h>\n")
        self.write("src/wend/core/a.h", "#include <wend/core/b.h>\n")
        self.write("src/wend/core/b.h", "")
        self.write("src/wend/capi/guide.h", "")
        self.write("cmake/public-headers.txt", listed)
        return list(check_public.offences(self.root))

    def test_what_is_included_is_listed_and_nothing_else(self):
        whole = "wend/capi/guide.h\nwend/core/a.h\nwend/core/b.h\nwend/guide.hpp\n"
        self.assertEqual(self.offences(whole), [])
        self.assertEqual(len(self.offences(whole.replace("wend/core/b.h\n", ""))), 1)
        self.assertEqual(len(self.offences(whole + "wend/core/c.h\n")), 1)


class Extensions(Tree):
    def test_a_file_that_begins_to_know_one_is_refused(self):
        for name, lines in {"medium/draine.h": "", "medium/draine.cpp": "", "medium/phase.h": "Draine\n" * 3,
                            "medium/tabulated_phase.cpp": "Draine\n",
                            "io/load/phase_functions.cpp": "// Draine\n" + "Draine\n" * 6}.items():
            self.write(f"src/wend/{name}", lines)
        known = {"a phase function": check_extensions.EXTENSIONS["a phase function"]}
        with unittest.mock.patch.object(check_extensions, "EXTENSIONS", known):
            self.assertEqual(list(check_extensions.offences(self.root)), [])
            self.write("src/wend/core/a.h", "Draine\n")
            self.assertEqual(len(list(check_extensions.offences(self.root))), 1)
            self.write("src/wend/medium/phase.h", "Draine\n" * 4)
            self.assertEqual(len(list(check_extensions.offences(self.root))), 2)


class Tables(Tree):
    MARKERS = "text\n<!-- table: demo -->\n<!-- /table -->\nmore\n"

    def setUp(self):
        super().setUp()
        self.write("bench/results/demo.json", json.dumps({
            "commit": "abc", "dirty": False, "date": "2026-01-02", "machine": {"cpu": "A", "cores": 2, "os": "B"},
            "settings": {"seconds": 5, "threads": 2}, "rows": [
                {"scene": "demo", **preset, "seed": seed, "samples": 10 * seed, "seconds": 5, "cpu_seconds": 10,
                 "wall_seconds": 5, "relmse": relmse, "relmse_trimmed": relmse / 2, "error_p9999": 1}
                for seed, classical, full in ((1, 2, 0.5), (2, 9, 0.25), (3, 1, 0.125))
                for preset, relmse in ((tables.CLASSICAL, classical), (tables.FULL, full))]}))

    def offences(self, text):
        self.write("README.md", text)
        return list(tables.offences(self.root))

    def rewritten(self):
        return tables.rewritten(self.root, self.MARKERS)[0]

    def test_medians_over_seeds(self):
        self.assertIn("| `demo` | 20, 2 (1) | 20, 0.25 (0.125) | 8 (8) |\n", self.rewritten())
        self.assertIn("*Commit `abc`, 2 January 2026, A, two cores, B. 5 seconds for each render, training included, "
                      "three seeds (medians). ", self.rewritten())

    def test_what_was_written_passes_and_is_not_written_again(self):
        self.assertEqual(self.offences(self.rewritten()), [])
        self.assertEqual(tables.rewritten(self.root, self.rewritten())[0], self.rewritten())

    def test_another_figure_is_refused_with_its_place(self):
        found = self.offences(self.rewritten().replace("0.25", "0.24"))
        self.assertEqual(len(found), 1)
        self.assertIn("README.md:2: table 'demo' is not what the results give", found[0])

    def test_tables_without_results_name_or_end_are_refused(self):
        self.assertIn("measure.py public", self.offences(self.MARKERS.replace("demo", "public-equal-time"))[0])
        self.assertIn("no table 'nothing'", self.offences(self.MARKERS.replace("demo", "nothing"))[0])
        self.assertIn("has no end", self.offences("<!-- table: demo -->\n|\n")[0])

    def test_digits(self):
        self.assertEqual([tables.digits(x) for x in (126.4, 11664.2, 0.27012, 7.263e-5, 0.27, 0, float("nan"))],
                         ["126", "11700", "0.270", "7.26e-5", "0.27", "0", "–"])


class Results(Tree):
    HEADER = {"commit": "abc", "dirty": False, "date": "2026-01-02", "machine": {}, "settings": {"seconds": 5}}

    def results(self, fresh=False, **changes):
        return measure.Results(self.root / "results/x.json", {**self.HEADER, **changes}, fresh)

    def test_a_stopped_run_goes_on(self):
        self.results().append({"scene": "a", "seed": 1})
        later = self.results(date="2026-01-03")
        self.assertTrue(later.has(scene="a", seed=1))
        self.assertFalse(later.has(scene="a", seed=2))
        later.append({"scene": "a", "seed": 2})
        self.assertEqual(len(json.loads((self.root / "results/x.json").read_text())["rows"]), 2)

    def test_rows_of_another_program_or_setting_are_refused(self):
        self.results().append({"scene": "a", "seed": 1})
        for changes in ({"commit": "def"}, {"settings": {"seconds": 6}}, {"machine": {"cpu": "C"}}, {"dirty": True}):
            with self.assertRaises(SystemExit):
                self.results(**changes)
        self.assertFalse(self.results(fresh=True, commit="def").has(scene="a"))


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
