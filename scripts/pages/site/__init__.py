"""The documentation as a site: pages staged for Sphinx, the reference of both languages, notebooks and the gallery."""
