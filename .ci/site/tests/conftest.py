"""One Chromium for all tests of the site; where there is none, they are skipped."""

import pytest
import reader


@pytest.fixture(scope="session")
def browser():
    """Chromium without a window."""
    from playwright import sync_api

    if not reader.chromium():
        pytest.skip("there is no Chromium here")
    with sync_api.sync_playwright() as player:
        # as root, in a container, it starts only without the sandbox; it opens nothing but files that were just built
        opened = player.chromium.launch(executable_path=reader.chromium(), args=["--no-sandbox", "--disable-gpu"])
        yield opened
        opened.close()
