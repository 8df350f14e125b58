"""What `import zlmreport` offers to notebooks and scripts: readings, evaluations, error models, certificates.

Micrometres and millimetres (arc seconds and degrees) at this door, SI behind it.
"""
