"""Numbers and what they mean: units, axes, frames and seconds, what is finite, how much work is allowed."""
