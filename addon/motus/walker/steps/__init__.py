"""Steps that are chosen by hand: dragged, turned and locked, in the viewport, in the panel and from scripts."""
