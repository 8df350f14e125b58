"""Certificates set as HTML by templates; the only user of Jinja."""
