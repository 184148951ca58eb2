"""Motion drivers: typed by hand and put on properties, also where scripts may not run by themselves."""

import math

import bpy
import motus_native_of_addon as native_of
import support
