"""Data that is kept with evaluated copies of datablocks, for each thread, or during one evaluation."""
