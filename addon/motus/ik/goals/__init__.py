"""What chains reach for: targets and poles, where they are, and where new ones are placed."""
