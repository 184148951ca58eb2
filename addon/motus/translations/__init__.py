"""Translations of the interface, a package a language."""

from . import es

LANGUAGES = {"es": es.CONTEXTS}
"""Language -> {context: {English: translation}}, which registration hands to Blender."""
