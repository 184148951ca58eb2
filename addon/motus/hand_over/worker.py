"""Script of the second Blender: opens a copy of the file, hands it over, and saves the result. The arguments are JSON after `--`.

Blender runs this file as a script, so it imports the add-on by its name, which `package` gives.
"""

import importlib
import json
import sys

package = json.loads(sys.argv[sys.argv.index("--") + 1])["package"]
importlib.import_module(f"{package}.hand_over.second").run(json.loads(sys.argv[sys.argv.index("--") + 1]))
