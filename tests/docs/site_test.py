#!/usr/bin/env python3
"""What makes the site, and its checks: each is given something to refuse."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "site"))
from wend_site import check_commands, check_links, docstrings, formulas, interfaces, options, sources
from wend_site.layout import Layout

TREE = [
    {"name": "", "description": "", "footer": "", "arguments": [], "options": [{"names": ["--version"]}]},
    {"name": "render", "description": "", "footer": "", "arguments": [], "options": [{"names": ["-o", "--output"]}, {"names": ["--spp"]}]},
]


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, path, text=""):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


class Pages(Folder):
    def setUp(self):
        super().setUp()
        for path in ("README.md", "docs/theory/planar.md", "docs/usd.md", "docs/site/tutorials/artist.md", "examples/embed/main.cpp",
                     "docs/images/demo.png", "docs/references.bib", "docs/experiments/README.md"):
            self.write(path)
        self.layout = Layout(self.root, self.root / "out" / "pages")

    def link(self, target, document):
        return self.layout.link(target, document)

    def test_links_follow_documents_to_their_pages(self):
        self.assertEqual(self.link("docs/theory/planar.md#nodes", "README.md"), "theory/planar.md#nodes")
        self.assertEqual(self.link("../usd.md", "docs/theory/planar.md"), "../guides/usd.md")
        self.assertEqual(self.link("../../usd.md", "docs/site/tutorials/artist.md"), "../guides/usd.md")
        self.assertEqual(self.link("../../README.md", "docs/theory/planar.md"), "../overview.md")

    def test_folders_have_pages(self):
        self.assertEqual(self.link("docs/theory", "README.md"), "theory/index.md")
        self.assertEqual(self.link("docs/experiments", "README.md"), "experiments/index.md")
        self.assertEqual(self.link("docs/references.bib", "README.md"), "bibliography.md")

    def test_sources_get_pages(self):
        self.assertEqual(self.link("../examples/embed", "docs/usd.md"), "../source/examples/embed.md")
        self.assertEqual(self.link("docs/images/demo.png", "README.md"), "../../docs/images/demo.png")
        sources.stage_sources(self.layout)
        self.assertIn("](embed/main.cpp.md)", (self.layout.pages / "source/examples/embed.md").read_text())
        self.assertIn("literalinclude", (self.layout.pages / "source/examples/embed/main.cpp.md").read_text())

    def test_what_is_broken_or_elsewhere_stays(self):
        for target in ("nowhere.md", "https://example.org/a.md", "#here", "../outside.md"):
            self.assertEqual(self.link(target, "README.md"), target)

    def test_code_is_no_link(self):
        text = "[a](docs/usd.md)\n```cpp\n[a](docs/usd.md)\n```\n[a](docs/usd.md)"
        self.assertEqual(self.layout.rewritten(text, "README.md"), "[a](guides/usd.md)\n```cpp\n[a](docs/usd.md)\n```\n[a](guides/usd.md)")

    def test_included_files_are_found_from_the_page(self):
        text = self.layout.rewritten("```{literalinclude} scene.usda\n```", "docs/site/tutorials/artist.md")
        self.assertEqual(text, "```{literalinclude} ../../../docs/site/tutorials/scene.usda\n```")


class Links(Folder):
    def found(self, text):
        self.write("a.html", text)
        self.write("b/c.html", '<h1 id="there">c</h1>')
        return check_links.offences(self.root)

    def test_good_ones(self):
        text = '<p id="here"></p><a href="#here">1</a><a href="b/c.html#there">2</a><a href="https://example.org/x">3</a><img src="b/c.html">'
        self.assertEqual(self.found(text), [])

    def test_missing_pages_anchors_and_pictures(self):
        text = '<a href="nowhere.html">1</a><a href="#nowhere">2</a><a href="b/c.html#nowhere">3</a><img src="nowhere.png">'
        self.assertEqual(len(self.found(text)), 4)

    def test_what_a_browser_would_fetch_from_the_network(self):
        for text in ('<script src="https://example.org/x.js"></script>', '<link rel="stylesheet" href="//example.org/x.css">'):
            self.assertEqual(len(self.found(text)), 1, text)


class Commands(unittest.TestCase):
    def found(self, line):
        return list(check_commands.offences(f"```sh\n{line}\n```\n", TREE, "page"))

    def test_good_ones(self):
        for line in ("wend render a.pbrt --spp 4 -o a.exr", "build/release/bin/wend --version", "git clone x wend && cd wend",
                     "A=1 mpirun -n 2 wend render a.pbrt --spp=4  # --nothing", "echo wend --nothing"):
            self.assertEqual(self.found(line), [], line)

    def test_options_and_subcommands_that_there_are_not(self):
        for line in ("wend render a.pbrt --samples 4", "wend paint a.pbrt", "cd x && wend render \\\n  --samples 4", "mpirun -n 2 wend paint"):
            self.assertEqual(len(self.found(line)), 1, line)


class Texts(Folder):
    def test_formulas(self):
        self.assertEqual(formulas.formula_html("a_k e^{−x/v_k}"), "<i>a</i><sub><i>k</i></sub> <i>e</i><sup>−<i>x</i>/<i>v</i><sub><i>k</i></sub></sup>")
        self.assertEqual(formulas.formula_html("sqrt(w) < 1, dmu0"), "√(<i>w</i>) &lt; 1, d<i>μ</i><sub>0</sub>")
        self.assertEqual(formulas.formula_html("e^{x"), "e^{x")
        self.assertEqual(formulas.IN_TEXT.findall("sigma_s, w_c and e^{−s} of mu0, music_x"), ["w_c", "e^{−s}", "mu0"])

    def test_docstrings(self):
        self.assertEqual(docstrings.as_rst(["As `load()`, `a[0]`s."]), [r"As :py:obj:`load`, ``a[0]``\ s."])
        self.assertEqual(docstrings.as_rst(["So:", "", "    x = 1"]), ["So:", "", ".. code-block:: python", "", "    x = 1"])
        self.assertEqual(docstrings.as_rst(["Args:", "    x: that"]), ["Args:", "    x: that"])
        self.assertEqual(docstrings.as_rst(["```python", "x", "```", "y"]), [".. code-block:: python", "", "    x", "", "y"])

    def test_descriptions_are_no_markup(self):
        words = options.words("*a* <b> of --spp, not --time", TREE[1], {"--spp"})
        self.assertEqual(words, r"\*a\* \<b\> of {option}`--spp <wend render --spp>`, not `--time`")

    def test_comments_of_headers(self):
        self.write("a.h", "// One.\n// Two.\n#pragma once\n// Three.\n")
        self.write("b.h", "/**\n * One.\n * Two. */\n")
        self.write("c.h", "#pragma once\n/// One.\n/// Two.\nstruct C;\n/// Three.\n")
        self.assertEqual(interfaces.header_comment(self.root / "a.h"), "One. Two.")
        self.assertEqual(interfaces.header_comment(self.root / "c.h"), "One. Two.")
        self.assertEqual(interfaces.header_comment(self.root / "b.h").strip(), "One. Two.")


if __name__ == "__main__":
    unittest.main()
