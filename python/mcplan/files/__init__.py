"""Scenes, robots and plans on disk."""
