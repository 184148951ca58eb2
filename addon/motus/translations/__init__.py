"""One module a language; core/translations.py collects them."""
