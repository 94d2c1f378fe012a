"""What Sphinx makes the site with; build.py passes where things are."""

import os
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

project = "Wend"
author = "The authors of Wend"
release = os.environ["WEND_VERSION"]
extensions = [
    "breathe",
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinxcontrib.bibtex",
    "wend_site.documents",
]
# Hyphens of options stay hyphens.
smartquotes = False
nitpicky = False
default_role = "py:obj"
highlight_language = "none"

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 4

breathe_projects = {"wend": os.environ["WEND_DOXYGEN_XML"]}
breathe_default_project = "wend"
breathe_domain_by_file_pattern = {"*/capi/*.h": "c"}
breathe_show_include = False

bibtex_bibfiles = [str(ROOT / "docs" / "references.bib")]
bibtex_default_style = "by_author"
bibtex_reference_style = "authors_and_year"
wend_bibliography = str(ROOT / "docs" / "references.bib")

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_type_aliases = {"npt.ArrayLike": "ArrayLike", "npt.NDArray": "NDArray"}
# Whoever reads the pages need not have them.
autodoc_mock_imports = ["bmesh", "bpy", "mathutils", "pxr"]

html_theme = "furo"
html_title = "Wend"
html_static_path = [str(HERE / "static")]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_copyright = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#8a4b08", "color-brand-content": "#8a4b08"},
    "dark_css_variables": {"color-brand-primary": "#f0b060", "color-brand-content": "#f0b060"},
}
copybutton_exclude = ".linenos, .gp, .go"
