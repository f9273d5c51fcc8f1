"""Pages for the browser: plans, scenes and runs."""
