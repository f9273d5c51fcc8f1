"""What scripts/wheels and scripts/release do: notices and bill of materials of a wheel, and the checklist of a release."""
