"""The plugins that come with zlmreport; they are found by entry point, like anybody else's."""
