"""What lives in a vertical plane: whole-body plans of planar robots made, tracked and drawn."""
