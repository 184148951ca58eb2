"""What is kept of evaluated copies, by threads, and during one evaluation."""
