"""Hubs, the hidden meshes that carry a solver and its outbox: whose they are, and what lies where in them."""
