"""Editors as they are on the screen: viewports and what lies under the mouse, widths, drawing in pixels, graphs, tools, redraws."""
