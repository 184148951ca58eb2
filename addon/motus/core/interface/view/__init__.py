"""Editors on the screen: viewports and what is under the mouse, widths of regions, drawing in pixels, graphs, tools, redraws."""
