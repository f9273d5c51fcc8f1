"""Many scenes, robots, options and seeds planned at once."""
