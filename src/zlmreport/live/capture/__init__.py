"""Live capture: readings follow the visit list of a plan into a journal."""
