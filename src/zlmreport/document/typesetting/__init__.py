"""The Certificate set as HTML: the one place that uses Jinja."""
