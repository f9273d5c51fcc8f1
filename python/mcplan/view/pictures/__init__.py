"""Pictures: plans painted, runs rendered."""
