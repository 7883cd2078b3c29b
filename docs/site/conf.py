"""How Sphinx makes the site. tools/docs lays out its sources and runs it."""

import os
import re

project = "talus"
author = "the talus authors"
copyright = "the talus authors, MIT licence"

with open(os.environ["TALUS_BASE_H"], encoding="utf-8") as header:
    numbers = re.findall(r"#define TL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header.read())
release = version = ".".join(numbers)

extensions = ["myst_parser", "breathe"]
breathe_projects = {"talus": os.environ["TALUS_DOXYGEN_XML"]}
breathe_default_project = "talus"
breathe_domain_by_extension = {"h": "c"}
breathe_show_include = False
breathe_show_define_initializer = True
breathe_show_enumvalue_initializer = False

myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence", "deflist"]

# A word that a block cannot be lexed as is no fault of the page: output and pseudo-code are blocks too.
suppress_warnings = ["misc.highlighting_failure"]
highlight_language = "none"
nitpicky = False  # types of the headers are C's own, and every one of talus has its entry

html_theme = "furo"
html_title = f"talus {release}"
html_static_path = ["_static"]
html_css_files = ["talus.css"]
html_copy_source = False
html_show_sphinx = False
templates_path = []
exclude_patterns = []
